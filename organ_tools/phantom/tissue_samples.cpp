#include "organ_tools/phantom/tissue_samples.h"

#include <algorithm>
#include <cmath>

namespace omentum::phantom {
namespace {

constexpr double kSampleRounding_m = 0.002;  // m
const Vec3 kPlateHalf{0.1, 0.1, 0.005};
constexpr double kCylinderRadius = 0.03, kCylinderHalf = 0.06;

// Of a body whose sides are `beyond` away along axes at right angles, both or all three: the distance to its
// rounded edges outside, to the nearest side inside.
template <class Sides>
double rounded(const Sides& beyond) {
  const Sides outside = (beyond.array() + kSampleRounding_m).max(0.0).matrix();
  return outside.norm() + std::min(beyond.maxCoeff() + kSampleRounding_m, 0.0) - kSampleRounding_m;
}

}  // namespace

double plate_distance(const Vec3& p) {
  return rounded<Vec3>(p.cwiseAbs() - kPlateHalf);
}

ImplicitShape plate() {
  return {"plate", plate_distance, {{-0.105, -0.105, -0.01}, {0.105, 0.105, 0.01}}};
}

double cylinder_distance(const Vec3& p) {
  return rounded<Eigen::Vector2d>(
      {std::hypot(p.x(), p.y()) - kCylinderRadius, std::abs(p.z() + kCylinderHalf) - kCylinderHalf});
}

ImplicitShape cylinder() {
  return {"cylinder", cylinder_distance, {{-0.035, -0.035, -0.125}, {0.035, 0.035, 0.005}}};
}

}  // namespace omentum::phantom
