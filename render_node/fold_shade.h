// How much light from all around the loops of a tube take from each other.
#pragma once

#include "geometry/tube_axis.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// The tube as a row of balls: each hides of a surface element's sky its form factor, cos / D^2 r^2, of which
/// those that overlap share. What lies behind the element's plane hides nothing, a straight piece of the same
/// tube least of all. One thread.
class FoldShade {
 public:
  static constexpr std::size_t kStride = 3;  // sections for one ball

  explicit FoldShade(double radius_m) : radius_m_(static_cast<float>(radius_m)) {}

  /// Cross-sections of the tube, in order.
  void set(std::span<const geometry::TubeFrame> sections);

  /// Looks for balls near `place`: openness() means these from here on.
  void stand_at(const Vec3f& place);
  /// The fraction of ambient light that reaches an element there, kDeepestOpenness (surface_shading.h) to 1.
  /// `normal`: unit.
  float openness(const Vec3f& place, const Vec3f& normal) const;

 private:
  struct Ball {
    Vec3f place;
    float weight;  // share of a whole ball
  };
  float radius_m_;
  std::vector<Ball> balls_, near_;
};

}  // namespace omentum::render
