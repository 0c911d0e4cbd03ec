// An organ's surface, and whether a prepared scene's hands fit it.
#pragma once

#include "geometry/boxes.h"
#include "geometry/closest_points.h"
#include "organ/organ.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace omentum::test {

using geometry::Vec3;

/// Closest points and interpolated positions are doubles on an organ of decimetres.
inline constexpr double kOnSurface_m = 1e-9;

class Skin {
 public:
  explicit Skin(const std::string& organ_file)
      : organ_(organ::load_organ(organ_file, organ::Load::kMeshOnly)),
        x_(geometry::surface_positions(organ_.mesh, organ_.surface)) {}

  double distance(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const geometry::Triangle& t : organ_.surface.triangles)
      best = std::min(best,
                      geometry::closest_point_on_triangle(p, x_[t[0]], x_[t[1]], x_[t[2]]).squared_distance);
    return std::sqrt(best);
  }
  /// By the parity of a ray's crossings, in a direction that no mesh is aligned with.
  bool inside(const Vec3& p) const {
    const Vec3 far = p + Vec3(0.5773, 0.3217, 0.7512) * 10;
    int crossings = 0;
    for (const geometry::Triangle& t : organ_.surface.triangles)
      crossings +=
          geometry::intersect_segment_triangle(p, far, x_[t[0]], x_[t[1]], x_[t[2]]).has_value() ? 1 : 0;
    return crossings % 2 == 1;
  }
  double diagonal() const { return geometry::diagonal_around(x_); }
  double to_support(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < organ_.fixed.size(); ++n)
      if (organ_.fixed[n] != 0) best = std::min(best, (organ_.mesh.positions[n] - p).norm());
    return best;
  }

 private:
  organ::Organ organ_;
  std::vector<Vec3> x_;
};

inline void expect_hand_fits(const Skin& skin, const scene::HandSpec& hand) {
  const Vec3 p = hand.press_point, n = hand.press_normal, d = hand.slide_direction;
  EXPECT_LE(skin.distance(p), kOnSurface_m);
  EXPECT_NEAR(n.norm(), 1, 1e-9);
  EXPECT_NEAR(d.norm(), 1, 1e-9);
  EXPECT_NEAR(n.dot(d), 0, 1e-9) << "the slide is tangential";
  const double step = 0.01 * skin.diagonal();
  EXPECT_FALSE(skin.inside(p + step * n)) << "the normal points outward";
  EXPECT_TRUE(skin.inside(p - step * n));
  EXPECT_TRUE(skin.inside(p - hand.depth_m * n)) << "the organ is thicker than the hand presses";
}

}  // namespace omentum::test
