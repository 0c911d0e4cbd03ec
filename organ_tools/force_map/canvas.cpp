#include "organ_tools/force_map/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace omentum::force_map {

namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // package fonts-dejavu-core

Colour mixed(Colour a, Colour b, float share) {
  const auto mix = [share](float from, float to) { return from + share * (to - from); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

Canvas::Canvas(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Canvas::paint(int x, int y, Colour colour, float share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  Colour& pixel = pixels_[index(x, y)];
  pixel = mixed(pixel, colour, share);
}

void Canvas::fill(int x, int y, int width, int height, Colour colour) {
  for (int j = y; j < y + height; ++j) {
    for (int i = x; i < x + width; ++i) paint(i, j, colour);
  }
}

Canvas Canvas::halved() const {
  Canvas half(width_ / 2, height_ / 2, {});
  for (int y = 0; y < half.height_; ++y) {
    for (int x = 0; x < half.width_; ++x) {
      const Colour upper = mixed(at(2 * x, 2 * y), at(2 * x + 1, 2 * y), 0.5f);
      const Colour lower = mixed(at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1), 0.5f);
      half.paint(x, y, mixed(upper, lower, 0.5f));
    }
  }
  return half;
}

std::vector<std::uint8_t> Canvas::rgba() const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * pixels_.size());
  for (const Colour& pixel : pixels_)
    bytes.insert(bytes.end(), {byte_of(pixel.red), byte_of(pixel.green), byte_of(pixel.blue), 255});
  return bytes;
}

Lettering::Lettering(float pixels) : atlas_(std::make_unique<ImFontAtlas>()) {
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;  // a pixel of the atlas is one of the picture
  config.PixelSnapH = true;
  std::error_code ignored;
  if (!std::filesystem::exists(kFont, ignored) || !atlas_->AddFontFromFileTTF(kFont, pixels, &config))
    atlas_->AddFontDefault();
  atlas_->Build();
}

Lettering::~Lettering() = default;

float Lettering::width(const std::string& text) const {
  float sum = 0;
  for (const char c : text) sum += atlas_->Fonts[0]->FindGlyph(static_cast<unsigned char>(c))->AdvanceX;
  return sum;
}

void Lettering::write(Canvas& canvas, int x, int y, const std::string& text, Colour colour) const {
  unsigned char* alphas = nullptr;
  int atlas_width = 0, atlas_height = 0;
  atlas_->GetTexDataAsAlpha8(&alphas, &atlas_width, &atlas_height);
  float at = static_cast<float>(x);
  for (const char c : text) {
    const ImFontGlyph& glyph = *atlas_->Fonts[0]->FindGlyph(static_cast<unsigned char>(c));
    const int left = static_cast<int>(std::lround(at + glyph.X0)),
              top = y + static_cast<int>(std::lround(glyph.Y0));
    const int from_x = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(atlas_width)));
    const int from_y = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(atlas_height)));
    const int wide = static_cast<int>(std::lround(glyph.X1 - glyph.X0));
    const int high = static_cast<int>(std::lround(glyph.Y1 - glyph.Y0));
    for (int j = 0; j < high; ++j) {
      for (int i = 0; i < wide; ++i)
        canvas.paint(left + i, top + j, colour,
                     static_cast<float>(alphas[(from_y + j) * atlas_width + from_x + i]) / 255);
    }
    at += glyph.AdvanceX;
  }
}

}  // namespace omentum::force_map
