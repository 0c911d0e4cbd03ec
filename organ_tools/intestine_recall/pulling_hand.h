// A hand that takes the gut, pulls it somewhere and lets go, again and again.
#pragma once

#include "geometry/gut_shape.h"

#include <Eigen/Geometry>

#include <random>
#include <span>
#include <vector>

namespace omentum::intestine_recall {

/// Takes a free mass of the axis at random and pulls it by a spring to a target that goes to a random place
/// around the gut, then lets it fall. The same seed gives the same script.
class PullingHand {
 public:
  PullingHand(const geometry::GutShape& gut, std::uint64_t seed);

  /// The hand `step_s` later: forces on all masses that are at `x`, N; both [masses]. Read until the next
  /// call.
  std::span<const geometry::Vec3> pull(std::span<const geometry::Vec3> x, double step_s);

 private:
  double random(double low, double high);
  void take(std::span<const geometry::Vec3> x);

  geometry::GutLayout layout_;
  Eigen::AlignedBox3d around_;  // where targets lie
  std::mt19937_64 random_;
  std::vector<geometry::Vec3> forces_;
  geometry::MassId held_;
  geometry::Vec3 target_ = geometry::Vec3::Zero(), goal_ = geometry::Vec3::Zero();
  double since_s_ = 0;
};

}  // namespace omentum::intestine_recall
