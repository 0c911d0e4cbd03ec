#include "organ_tools/force_map/map_picture.h"

#include "geometry/tetra_faces.h"
#include "organ_tools/force_map/colour_scale.h"
#include "organ_tools/force_map/surface_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omentum::force_map {

namespace {

constexpr Colour kPaper{1, 1, 1}, kInk{0.13f, 0.14f, 0.16f}, kNoNumber{0.72f, 0.72f, 0.72f}, kLine{1, 1, 1};
constexpr int kFine = 2;  // pixels drawn for each that is kept, either way
// Layout, pixels.
constexpr int kMargin = 36, kLetters = 20, kLineHeight = 28, kScaleWidth = 26, kScaleRoom = 150, kBelow = 60;
constexpr double kRuler_m = 0.02;
constexpr double kBehind_m = 0.001;        // a node so far behind what is drawn at its pixel is hidden
constexpr int kDash = 10, kLineWidth = 3;  // fine pixels
constexpr float kShade = 0.35f;            // what is seen askew is darker by so much

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class MapPicture {
 public:
  MapPicture(const organ::Organ& organ, const std::vector<double>& values, const PictureOptions& options)
      : organ_(organ),
        values_(values),
        options_(options),
        x_(geometry::surface_positions(organ.mesh, organ.surface)),
        scale_{options.low, options.high},
        fine_(kFine * options.width, kFine * options.height, kPaper) {
    const double top = kMargin + kLineHeight * static_cast<double>(options.lines.size()) + kMargin * 0.5;
    view_ = fit(x_, options.from, kFine * kMargin, kFine * top,
                kFine * (options.width - 2 * kMargin - kScaleRoom),
                kFine * (options.height - top - kBelow - kMargin));
  }

  Canvas draw() {
    draw_surface();
    if (options_.outline_regions) draw_outline();
    Canvas canvas = fine_.halved();
    draw_peak(canvas);
    draw_scale(canvas);
    draw_ruler(canvas);
    for (std::size_t i = 0; i < options_.lines.size(); ++i)
      letters_.write(canvas, kMargin, kMargin + static_cast<int>(i) * kLineHeight, options_.lines[i], kInk);
    return canvas;
  }

 private:
  void draw_surface() {
    const std::vector<Vec3> normals = geometry::surface_normals(organ_.surface, x_);
    Raster raster(fine_.width(), fine_.height());
    for (const geometry::Triangle& t : organ_.surface.triangles) {
      std::array<RasterCorner, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = {x_[t[i]], values_[t[i]], normals[t[i]].dot(options_.from)};
      draw_triangle(corners, view_, raster);
    }
    for (int y = 0; y < raster.height; ++y) {
      for (int x = 0; x < raster.width; ++x) {
        const std::size_t pixel = raster.at(x, y);
        if (!std::isfinite(raster.nearness[pixel])) continue;
        const double value = raster.value[pixel];
        fine_.paint(x, y, std::isfinite(value) ? scale_.of(value) : kNoNumber);
        fine_.paint(x, y, kInk,
                    kShade * (1 - static_cast<float>(std::clamp(raster.facing[pixel], 0.0, 1.0))));
      }
    }
    if (options_.peak) peak_seen_ = is_in_front(x_[options_.peak->node], raster);
    if (options_.contour)
      draw_border(
          raster, [level = *options_.contour](double v) { return v > level; }, 0);
  }

  bool is_in_front(const Vec3& p, const Raster& raster) const {
    const int x = static_cast<int>(view_.x(p)), y = static_cast<int>(view_.y(p));
    const bool inside = x >= 0 && y >= 0 && x < raster.width && y < raster.height;
    return inside && raster.nearness[raster.at(x, y)] <= view_.nearness(p) + kBehind_m;
  }

  // The shadow of what is of a region's material.
  void draw_outline() {
    Raster raster(fine_.width(), fine_.height());
    for (std::size_t t = 0; t < organ_.mesh.tetrahedra.size(); ++t) {
      const geometry::TetId id(t);
      if (&organ_.material.of(organ_.mesh, id) == &organ_.material.common) continue;
      for (const auto& face : geometry::kFaceOpposite) {
        std::array<RasterCorner, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
          corners[i] = {organ_.mesh.positions[organ_.mesh.tetrahedra[t][static_cast<std::size_t>(face[i])]],
                        1, 0};
        draw_triangle(corners, view_, raster);
      }
    }
    draw_border(
        raster, [](double v) { return std::isfinite(v); }, kDash);
  }

  // Where a pixel is inside and one beside it is not; `dash`: in pieces so long, or 0.
  template <class Inside>
  void draw_border(const Raster& raster, Inside&& inside, int dash) {
    for (int y = 0; y + 1 < raster.height; ++y) {
      for (int x = 0; x + 1 < raster.width; ++x) {
        const bool here = inside(raster.value[raster.at(x, y)]);
        if (here == inside(raster.value[raster.at(x + 1, y)]) &&
            here == inside(raster.value[raster.at(x, y + 1)]))
          continue;
        if (dash > 0 && (x / dash + y / dash) % 2 == 0) continue;
        fine_.fill(x - kLineWidth / 2, y - kLineWidth / 2, kLineWidth, kLineWidth, dash > 0 ? kInk : kLine);
      }
    }
  }

  void draw_peak(Canvas& canvas) const {
    if (!options_.peak || !peak_seen_) return;
    const Vec3& p = x_[options_.peak->node];
    const int x = static_cast<int>(view_.x(p) / kFine), y = static_cast<int>(view_.y(p) / kFine), arm = 8;
    canvas.fill(x - arm, y - 1, 2 * arm + 1, 3, kInk);
    canvas.fill(x - 1, y - arm, 3, 2 * arm + 1, kInk);
  }

  void draw_scale(Canvas& canvas) const {
    const int left = options_.width - kScaleRoom,
              top = 3 * kMargin + kLineHeight * static_cast<int>(options_.lines.size());
    const int height = options_.height - top - 2 * kBelow;
    const double span = scale_.high - scale_.low;
    for (int i = 0; i < height; ++i)
      canvas.fill(left, top + height - 1 - i, kScaleWidth, 1,
                  scale_.of(scale_.low + span * i / (height - 1)));
    const int half = kLetters / 2;
    for (const double tick : scale_.ticks()) {
      const double part = span > 0 ? (tick - scale_.low) / span : 0.5;
      const int y = top + static_cast<int>(std::lround((1 - part) * (height - 1)));
      canvas.fill(left + kScaleWidth, y, 6, 1, kInk);
      letters_.write(canvas, left + kScaleWidth + 12, y - half, number(tick), kInk);
    }
    letters_.write(canvas, left, top - kLineHeight - 4, options_.unit, kInk);
    canvas.fill(left, top + height + 14, kScaleWidth, kLetters, kNoNumber);
    letters_.write(canvas, left + kScaleWidth + 12, top + height + 14, "none", kInk);
  }

  void draw_ruler(Canvas& canvas) const {
    const int length = static_cast<int>(std::lround(kRuler_m * view_.pixels_per_m / kFine));
    const int y = options_.height - kMargin;
    canvas.fill(kMargin, y - 3, length, 4, kInk);
    letters_.write(canvas, kMargin + length + 12, y - kLetters / 2 - 2, number(1e3 * kRuler_m) + " mm", kInk);
  }

  const organ::Organ& organ_;
  const std::vector<double>& values_;
  const PictureOptions& options_;
  std::vector<Vec3> x_;
  ColourScale scale_;
  Canvas fine_;
  Projection view_;
  bool peak_seen_ = false;
  Lettering letters_{static_cast<float>(kLetters)};
};

}  // namespace

Canvas draw_map(const organ::Organ& organ, const std::vector<double>& values, const PictureOptions& options) {
  return MapPicture(organ, values, options).draw();
}

}  // namespace omentum::force_map
