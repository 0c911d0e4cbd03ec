#include "render_node/close_up.h"

#include "geometry/closest_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace omentum::render {
namespace {

constexpr double kDistanceM = 0.085;
constexpr double kFieldDeg = 38;  // bottom to top: 6 cm of the surface, two dents
constexpr int kSides = 24;        // places around the dent that are tried
// Above the tangent plane: 23 degrees show the profile of a dent; from higher up it is seen between bulges.
constexpr std::array kElevationsRad{0.40, 0.65, 0.90, 1.15};
constexpr double kAboveBottomM =
    0.006;  // what is looked at: between the dent's bottom and the shaft above it

// What has to be seen: this far to both sides, just above the rim.
constexpr double kHalfWidthM = 0.008, kAboveRimM = 0.003;
constexpr double kRimM = 0.016;         // where lines of sight leave the dent
constexpr double kLeastHeightM = 0.01;  // of the eye above the table
// What hides the dent wholly, a shaft across it and a step higher up cost, against the 0..2 that turning away
// from the familiar side does: a hidden dent is no picture, and a flat view from behind beats a steep one.
constexpr double kHiddenCost = 20, kShaftCost = 2, kElevationCost = 2.5;

/// The drawn triangles around a dent that lines of sight may meet.
class Tissue {
 public:
  Tissue(std::span<const OrganSkin* const> skins, const Vec3& target) {
    for (const OrganSkin* skin : skins) {
      const MeshData& mesh = skin->mesh();
      for (const MeshTriangle& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{mesh.vertices[t[0]].position.cast<double>(),
                                          mesh.vertices[t[1]].position.cast<double>(),
                                          mesh.vertices[t[2]].position.cast<double>()};
        Eigen::AlignedBox3d box(corners[0]);
        box.extend(corners[1]).extend(corners[2]);
        if (box.squaredExteriorDistance(target) < kDistanceM * kDistanceM) triangles_.push_back(corners);
      }
    }
  }

  bool hides(const Vec3& point, const Vec3& eye) const {
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const std::array<Vec3, 3>& t) {
      return geometry::intersect_segment_triangle(point, eye, t[0], t[1], t[2]).has_value();
    });
  }

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
};

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

struct Candidate {
  Vec3 eye;
  double cost;  // of all but what tissue hides
};

// The dearest last.
std::vector<Candidate> candidates(const Camera& base, const Vec3& familiar_side,
                                  std::span<const Shaft> shafts, double ground_m) {
  std::vector<Candidate> found;
  const Vec3 first = base.up.unitOrthogonal();
  for (std::size_t step = 0; step < kElevationsRad.size(); ++step) {
    const double rad = kElevationsRad[step];
    for (int k = 0; k < kSides; ++k) {
      const Vec3 level = Eigen::AngleAxisd(2 * std::numbers::pi * k / kSides, base.up) * first;
      const Vec3 eye = base.target + kDistanceM * (std::cos(rad) * level + std::sin(rad) * base.up);
      double cost = 1 - level.dot(familiar_side) + kElevationCost * static_cast<double>(step);
      for (const Shaft& shaft : shafts) cost += kShaftCost * hidden_by(shaft, base.target, eye, base.up);
      if (eye.z() < ground_m + kLeastHeightM) cost += kHiddenCost;
      found.push_back({eye, cost});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return found;
}

// The share of the dent that tissue hides from `eye`.
double hidden_share(const Tissue& tissue, const Dent& dent, const Camera& base, const Vec3& eye) {
  const Vec3 across = (eye - base.target).cross(base.up).normalized();
  const Vec3 rim = dent.bottom.cast<double>() + (dent.depth_m + kAboveRimM) * base.up;
  const std::array<Vec3, 3> points{base.target, rim - kHalfWidthM * across, rim + kHalfWidthM * across};
  const auto hidden =
      std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return tissue.hides(p, eye); });
  return static_cast<double>(hidden) / static_cast<double>(points.size());
}

}  // namespace

Camera close_up_of(const Dent& dent, std::span<const OrganSkin* const> skins, std::span<const Shaft> shafts,
                   const Camera& familiar, double ground_m) {
  const Vec3 normal = dent.outward.cast<double>();
  const Vec3 target = dent.bottom.cast<double>() + kAboveBottomM * normal;
  Camera best{target, target, normal, kFieldDeg};
  const Tissue tissue(skins, target);
  double least_cost = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates(best, (familiar.eye - target).normalized(), shafts, ground_m)) {
    if (c.cost >= least_cost) break;  // the others cost more, even if nothing hides the dent from there
    const double cost = c.cost + kHiddenCost * hidden_share(tissue, dent, best, c.eye);
    if (cost >= least_cost) continue;
    least_cost = cost;
    best.eye = c.eye;
  }
  return best;
}

}  // namespace omentum::render
