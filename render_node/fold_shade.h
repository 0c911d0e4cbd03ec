// How much light from all around the loops of a tube take from each other.
#pragma once

#include "geometry/tube_axis.h"
#include "render_node/renderer.h"
#include "render_node/tube_item.h"

namespace omentum::render {

/// The tube as a row of balls: each hides of a surface element's sky its form factor, cos / D^2 r^2, of which
/// those that overlap share. What lies behind the element's plane hides nothing, a straight piece of the same
/// tube least of all. One thread.
class FoldShade {
 public:
  static constexpr std::size_t kStride = 3;  // sections for one ball

  explicit FoldShade(double radius_m) : radius_m_(static_cast<float>(radius_m)) {}

  /// Cross-sections of the tube, in order, so many of which have one ball.
  void set(std::span<const geometry::TubeFrame> sections, std::size_t stride = kStride);

  /// Looks for balls near `place`: openness() means these from here on.
  void stand_at(const Vec3f& place);
  /// The fraction of ambient light that reaches an element there, kDeepestOpenness (surface_shading.h) to 1.
  /// `normal`: unit.
  float openness(const Vec3f& place, const Vec3f& normal) const;
  /// The same of a wall that is one radius from `axis`, in directions evenly around from `k` towards `b`,
  /// which are its normals too: unit, and at right angles.
  std::array<float, SkinFrame::kDirections> around(const Vec3f& axis, const Vec3f& k, const Vec3f& b) const;

 private:
  struct Ball {
    Vec3f place;
    float weight;  // share of a whole ball
  };
  // Neighbours along the tube, and the ball around their centres.
  struct Row {
    Vec3f centre;
    float reach;
  };
  static constexpr std::size_t kRow = 8;  // balls
  void find_rows();

  float radius_m_;
  std::span<const Ball> near() const { return std::span(near_).first(near_count_); }

  std::vector<Ball> balls_;
  std::vector<Ball> near_;  // as long as balls_: the first near_count_ of it are near
  std::size_t near_count_ = 0;
  std::vector<Row> rows_;  // of balls_, kRow each
};

}  // namespace omentum::render
