#include "organ_tools/phantom/gallbladder_shape.h"

#include <algorithm>

namespace omentum::phantom {
namespace {

// Centres of the two ends, and the radius there, m. The line between them falls less than the liver's
// underside above it does: the sac is thin where it is deep.
const Vec3 kNeck{-0.0085, -0.0045, -0.0335}, kFundus{-0.0135, -0.0590, -0.0250};
constexpr double kNeckRadius = 0.0065, kFundusRadius = 0.0175;

// How far the neck bends down and away from the liver, where the duct leaves it.
const Vec3 kNeckBend{0.002, 0.0, -0.004};

double smooth_step(double t) {
  return t * t * (3 - 2 * t);
}

}  // namespace

double gallbladder_distance(const Vec3& p) {
  const Vec3 axis = kFundus - kNeck;
  const double t = std::clamp((p - kNeck).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  const Vec3 middle = kNeck + t * axis + (1 - t) * (1 - t) * kNeckBend;
  return (p - middle).norm() - (kNeckRadius + (kFundusRadius - kNeckRadius) * smooth_step(t));
}

ImplicitShape gallbladder() {
  return {"gallbladder", gallbladder_distance, {{-0.036, -0.082, -0.054}, {0.010, 0.008, -0.002}}};
}

}  // namespace omentum::phantom
