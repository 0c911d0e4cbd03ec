#include "render_node/close_up.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace omentum::render {
namespace {

constexpr double kDistanceM = 0.085;
constexpr double kElevationRad = 0.40;  // 23 degrees above the tangent plane: into the dent, and over its rim
constexpr double kFieldDeg = 38;        // bottom to top: 6 cm of the surface, two dents
constexpr int kSides = 24;              // places around the dent that are tried
constexpr double kAboveBottomM =
    0.006;  // what is looked at: between the dent's bottom and the shaft above it

// How wide the lines of sight to a dent are, and where they leave it, m.
constexpr double kSightHalfWidthM = 0.012, kRimM = 0.016;
// What a bulge across the sight and a shaft across it cost, against the 0..2 that turning away from the
// familiar side does.
constexpr double kBulgeCostPerM = 400, kShaftCost = 2;

// 0: the line of sight from `target` to `eye` passes above the surface; else how far the surface rises into
// it, m.
double bulge(const OrganSkin& skin, const Vec3& target, const Vec3& eye, const Vec3& normal) {
  const Vec3 along = (eye - target).normalized();
  const Vec3 across = along.cross(normal).normalized();
  const Vec3 above = across.cross(along);
  double highest = 0;
  for (std::int32_t s = 0; s < skin.node_count(); ++s) {
    const Vec3 p = skin.position(geometry::SurfaceId(s)).cast<double>() - target;
    const double ahead = p.dot(along);
    if (ahead < kRimM || ahead > kDistanceM || std::abs(p.dot(across)) > kSightHalfWidthM) continue;
    highest = std::max(highest, p.dot(above));
  }
  return highest;
}

// 0..1: how far a shaft leans into the line of sight, seen from above the surface.
double hidden_by(const Shaft& shaft, const Vec3& target, const Vec3& eye, const Vec3& normal) {
  const Vec3 sight = (eye - target).normalized();
  const Vec3 across = sight.cross(normal).normalized();
  const Vec3 tip = shaft.tip - target;
  const double lean = std::max(0.0, shaft.towards_handle.dot(sight));
  // a shaft between eye and dent; one that stands beside or behind it hides nothing
  if (tip.dot(sight) > kRimM && tip.dot(sight) < kDistanceM && std::abs(tip.dot(across)) < kRimM) return 1;
  return tip.norm() < kRimM ? lean : 0;
}

}  // namespace

Camera close_up_of(const Dent& dent, const OrganSkin& skin, std::span<const Shaft> shafts,
                   const Camera& familiar) {
  const Vec3 normal = dent.outward.cast<double>();
  const Vec3 target = dent.bottom.cast<double>() + kAboveBottomM * normal;
  const Vec3 first = normal.unitOrthogonal();
  const Vec3 side = (familiar.eye - target).normalized();
  Camera best{target, target, normal, kFieldDeg};
  double least_cost = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSides; ++k) {
    const Vec3 level = Eigen::AngleAxisd(2 * std::numbers::pi * k / kSides, normal) * first;
    const Vec3 eye =
        target + kDistanceM * (std::cos(kElevationRad) * level + std::sin(kElevationRad) * normal);
    double cost = 1 - level.dot(side) + kBulgeCostPerM * bulge(skin, target, eye, normal);
    for (const Shaft& shaft : shafts) cost += kShaftCost * hidden_by(shaft, target, eye, normal);
    if (cost >= least_cost) continue;
    least_cost = cost;
    best.eye = eye;
  }
  return best;
}

}  // namespace omentum::render
