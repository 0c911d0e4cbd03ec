// Pixels, and letters on them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct ImFontAtlas;

namespace omentum::force_map {

/// sRGB, 0 to 1.
struct Colour {
  float red = 0, green = 0, blue = 0;
};

/// [height][width], the top row first.
class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }
  const Colour& at(int x, int y) const { return pixels_[index(x, y)]; }
  /// Covers the pixel by `share` of `colour`; outside of the canvas nothing happens.
  void paint(int x, int y, Colour colour, float share = 1);
  void fill(int x, int y, int width, int height, Colour colour);

  /// Half as wide and high, each pixel the mean of four: edges become smooth.
  Canvas halved() const;
  std::vector<std::uint8_t> rgba() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<Colour> pixels_;
};

/// A font: DejaVu Sans where it is installed, else the one that Dear ImGui brings along.
class Lettering {
 public:
  explicit Lettering(float pixels);
  ~Lettering();
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  float width(const std::string& text) const;
  /// (x, y): the left upper corner of the text's line.
  void write(Canvas& canvas, int x, int y, const std::string& text, Colour colour) const;

 private:
  std::unique_ptr<ImFontAtlas> atlas_;
};

}  // namespace omentum::force_map
