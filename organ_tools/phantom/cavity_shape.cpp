#include "organ_tools/phantom/cavity_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omentum::phantom {
namespace {

// All of it in metres, to the measure of a liver of 18 cm. Ports of the scenes' instruments lie on it.
const Ellipsoid kWall{{0, -0.18, -0.01}, {0.27, 0.285, 0.195}};

// A rib follows the wall in a plane that falls forwards by this much; it is round, and so much of it stands
// out.
constexpr double kRibFall = 0.45, kRibRadius = 0.009, kRibStandsOut = 0.004;
constexpr std::array kRibs{0.080, 0.042, 0.004, -0.034, -0.072};  // of the planes, where z is 0: y
constexpr double kPeritoneum = 0.007;                             // how smoothly the wall goes over a rib

// The costal arch: from under the breastbone outwards and down; ribs end on it.
constexpr double kArchTop = 0.05, kArchOpening = 0.9;  // y of its top; how far it opens, of the way down
constexpr double kArchFrom = 0.03;                     // z: only the front has one

// Of the omentum: its level, how much that falls towards the feet, and how far down it is thick.
constexpr double kOmentumLevel = -0.079, kFall = 0.07, kBottom = -0.125;
constexpr double kLobe = 0.0045, kLobeWidth = 0.07, kEdge = 0.005;
constexpr double kIntoWall = 0.003;  // no gap is seen between both

// Of a round ridge along the wall, in the surface on which `off` is zero. `wall`: the distance to the bare
// wall.
double ridge(double wall, double off) {
  return std::hypot(wall - (kRibRadius - kRibStandsOut), off) - kRibRadius;
}

// Off the costal arch along the wall, outwards positive.
double off_arch(const Vec3& p) {
  return (std::abs(p.x()) - kArchOpening * (kArchTop - p.y())) / std::hypot(1, kArchOpening);
}

double ribs(double wall, const Vec3& p) {
  double nearest = 1;
  for (const double at : kRibs) {
    const double off = (p.y() + kRibFall * p.z() - at) / std::hypot(1, kRibFall);
    nearest = std::min(nearest, ridge(wall, off));
  }
  nearest = std::max(nearest, std::min(p.z() - kArchFrom, -off_arch(p)));  // at the back, or beyond the arch
  const double arch = std::max(ridge(wall, off_arch(p)), kArchFrom - p.z());
  return blended_min(nearest, arch, kPeritoneum);
}

double omentum_top(double x, double y) {
  constexpr double kTurn = 2 * std::numbers::pi / kLobeWidth;
  const double across = std::sin(kTurn * x + 0.9 * std::sin(0.6 * kTurn * y));
  const double along = std::sin(1.2 * kTurn * y + 1.3 + 0.8 * std::sin(0.5 * kTurn * x));
  return kOmentumLevel + kFall * std::min(0.0, y) + kLobe * (across + 0.8 * along);
}

}  // namespace

double cavity_distance(const Vec3& p) {
  const double wall = ellipsoid_distance(kWall, p);
  return blended_max(wall, -ribs(wall, p), kPeritoneum);
}

ImplicitShape cavity() {
  return {"cavity", cavity_distance, {{-0.28, -0.475, -0.215}, {0.28, 0.115, 0.195}}};
}

double omentum_distance(const Vec3& p) {
  const double inside = ellipsoid_distance(kWall, p) - kIntoWall;
  const double slab = std::max(p.z() - omentum_top(p.x(), p.y()), kBottom - p.z());
  return blended_max(inside, slab, kEdge);
}

ImplicitShape omentum() {
  return {"omentum", omentum_distance, {{-0.28, -0.475, -0.14}, {0.28, 0.115, -0.05}}};
}

}  // namespace omentum::phantom
