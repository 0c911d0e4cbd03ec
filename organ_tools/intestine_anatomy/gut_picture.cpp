#include "organ_tools/intestine_anatomy/gut_picture.h"

#include "geometry/gut_skin.h"
#include "organ_tools/force_map/surface_raster.h"

#include <algorithm>
#include <cmath>

namespace omentum::gut_picture {
namespace {

using force_map::Canvas;
using force_map::Colour;
using geometry::Vec3;

constexpr Colour kPaper{1, 1, 1}, kInk{0.13f, 0.14f, 0.16f};
constexpr Colour kGut{0.89f, 0.56f, 0.50f}, kMesentery{0.96f, 0.86f, 0.62f};
constexpr double kOfGut = 0, kOfMesentery = 1;  // what the raster carries
constexpr int kFine = 2;                        // pixels drawn for each that is kept, either way
constexpr int kMargin = 36, kLetters = 20, kLineHeight = 28, kBelow = 40;  // pixels
constexpr double kRuler_m = 0.1;
constexpr float kShade = 0.65f;  // what is seen askew is darker by so much

// The skin at one moment.
struct Skin {
  geometry::GutSkin skin;
  std::vector<Vec3> places, normals;  // [nodes]; normals unit or 0

  explicit Skin(const geometry::GutShape& gut)
      : skin(gut), places(skin.node_count()), normals(skin.node_count(), Vec3::Zero()) {
    skin.place(gut.positions, places);
    for (const auto& [a, b, c] : skin.triangles()) {
      const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
      for (const geometry::NodeId n : {a, b, c}) normals[static_cast<std::size_t>(n)] += normal;
    }
    for (Vec3& n : normals) n.stableNormalize();
  }
  const Vec3& place(geometry::NodeId n) const { return places[static_cast<std::size_t>(n)]; }
};

// A face of the mesentery has a corner that the axis does not carry.
bool is_of_gut(const Skin& skin, const geometry::GutLayout& layout,
               const std::array<geometry::NodeId, 3>& face) {
  return std::ranges::all_of(face,
                             [&](geometry::NodeId n) { return layout.row(skin.skin.node(n).mass[0]) == 0; });
}

Colour colour_of(double part, double facing) {
  const Colour& own = part == kOfGut ? kGut : kMesentery;
  const auto light = 1 - kShade * (1 - static_cast<float>(facing));
  return {own.red * light, own.green * light, own.blue * light};
}

void draw_skin(const Skin& skin, const geometry::GutLayout& layout, const force_map::Projection& view,
               Canvas& canvas) {
  force_map::Raster raster(canvas.width(), canvas.height());
  for (const auto& face : skin.skin.triangles()) {
    const double part = is_of_gut(skin, layout, face) ? kOfGut : kOfMesentery;
    std::array<force_map::RasterCorner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto n = static_cast<std::size_t>(face[i]);
      corners[i] = {skin.places[n], part, std::abs(skin.normals[n].dot(view.towards))};
    }
    force_map::draw_triangle(corners, view, raster);
  }
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const std::size_t pixel = raster.at(x, y);
      if (std::isfinite(raster.value[pixel]))
        canvas.paint(x, y, colour_of(std::round(raster.value[pixel]), raster.facing[pixel]));
    }
  }
}

void draw_ruler(const force_map::Lettering& letters, double pixels_per_m, Canvas& canvas) {
  const int length = static_cast<int>(std::lround(kRuler_m * pixels_per_m)), y = canvas.height() - kMargin;
  canvas.fill(kMargin, y - 3, length, 4, kInk);
  letters.write(canvas, kMargin + length + 12, y - kLetters / 2 - 2, "10 cm", kInk);
}

}  // namespace

Canvas draw_gut(const geometry::GutShape& gut, const PictureOptions& options) {
  const Skin skin(gut);
  Canvas fine(kFine * options.width, kFine * options.height, kPaper);
  const double top = 1.5 * kMargin + kLineHeight * static_cast<double>(options.lines.size());
  const force_map::Projection view = force_map::fit(skin.places, options.from, kFine * kMargin, kFine * top,
                                                    kFine * (options.width - 2.0 * kMargin),
                                                    kFine * (options.height - top - kBelow - kMargin));
  draw_skin(skin, gut.layout, view, fine);
  Canvas canvas = fine.halved();
  const force_map::Lettering letters(static_cast<float>(kLetters));
  draw_ruler(letters, view.pixels_per_m / kFine, canvas);
  for (std::size_t i = 0; i < options.lines.size(); ++i)
    letters.write(canvas, kMargin, kMargin + static_cast<int>(i) * kLineHeight, options.lines[i], kInk);
  return canvas;
}

}  // namespace omentum::gut_picture
