#include "render_node/close_up.h"

#include "geometry/closest_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

namespace omentum::render {
namespace {

constexpr double kDistance_m = 0.085;
constexpr double kField_deg = 38;  // bottom to top: 6 cm of the surface, two dents
constexpr int kSides = 24;         // places around the dent that are tried
// Above the tangent plane: 23 degrees show the profile of a dent; from higher up it is seen between bulges.
constexpr std::array kElevations_rad{0.40, 0.65, 0.90, 1.15};
constexpr double kAboveBottom_m =
    0.006;  // what is looked at: between the dent's bottom and the shaft above it

// What has to be seen besides: lower down, where a flat sight still passes over the dent's own rim; to both
// sides at the same height; and further out, just above the rim.
constexpr double kLow_m = 0.004, kInside_m = 0.005, kOutside_m = 0.008, kAboveRim_m = 0.003;
constexpr double kRim_m = 0.016;          // a shaft that ends so near to the dent is the one that presses it
constexpr double kShaftRadius_m = 0.006;  // with what is thicker on it
constexpr double kLeastHeight_m = 0.01;   // of the eye above the table
// What hides the dent wholly, its own shaft towards the eye and a step higher up cost, against the 0..2 that
// turning away from the familiar side does: a hidden dent is no picture, and a flat view from behind beats a
// steep one.
constexpr double kHiddenCost = 20, kLeanCost = 2, kElevationCost = 2.5;

// The least distance between the segment p..q and the half-line of a shaft.
double distance(const Vec3& p, const Vec3& q, const Shaft& shaft) {
  const Vec3 along = q - p, from = p - shaft.tip;
  const double length = along.squaredNorm(), slant = along.dot(shaft.towards_handle);
  const double square = length - slant * slant;  // 0: parallel, and any place will do
  const double both = slant * from.dot(shaft.towards_handle) - along.dot(from);
  double on_segment = square > 0 ? std::clamp(both / square, 0.0, 1.0) : 0.0;
  const double on_shaft = (from + on_segment * along).dot(shaft.towards_handle);
  if (on_shaft >= 0) return (from + on_segment * along - on_shaft * shaft.towards_handle).norm();
  on_segment = length > 0 ? std::clamp(-along.dot(from) / length, 0.0, 1.0) : 0.0;  // nearest to the tip
  return (from + on_segment * along).norm();
}

bool presses(const Shaft& shaft, const Vec3& target) {
  return (shaft.tip - target).norm() < kRim_m;
}

/// What lines of sight to a dent may meet: the drawn triangles around it, and the shafts of the other tools.
class Obstacles {
 public:
  Obstacles(std::span<const MeshData* const> organs, std::span<const Shaft> shafts, const Vec3& target) {
    std::copy_if(shafts.begin(), shafts.end(), std::back_inserter(shafts_),
                 [&](const Shaft& shaft) { return !presses(shaft, target); });
    for (const MeshData* organ : organs) {
      const MeshData& mesh = *organ;
      for (const MeshTriangle& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{mesh.vertices[t[0]].position.cast<double>(),
                                          mesh.vertices[t[1]].position.cast<double>(),
                                          mesh.vertices[t[2]].position.cast<double>()};
        Eigen::AlignedBox3d box(corners[0]);
        box.extend(corners[1]).extend(corners[2]);
        if (box.squaredExteriorDistance(target) < kDistance_m * kDistance_m) triangles_.push_back(corners);
      }
    }
  }

  bool hides(const Vec3& point, const Vec3& eye) const {
    const auto crosses = [&](const Shaft& shaft) { return distance(point, eye, shaft) < kShaftRadius_m; };
    if (std::any_of(shafts_.begin(), shafts_.end(), crosses)) return true;
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const std::array<Vec3, 3>& t) {
      return geometry::intersect_segment_triangle(point, eye, t[0], t[1], t[2]).has_value();
    });
  }

 private:
  std::vector<Shaft> shafts_;
  std::vector<std::array<Vec3, 3>> triangles_;
};

struct Candidate {
  Vec3 eye;
  double cost;  // of all but what is hidden
};

// The dearest last.
std::vector<Candidate> candidates(const Camera& base, const Vec3& familiar_side,
                                  std::span<const Shaft> shafts, double ground_m) {
  std::vector<Candidate> found;
  const Vec3 first = base.up.unitOrthogonal();
  for (std::size_t step = 0; step < kElevations_rad.size(); ++step) {
    const double rad = kElevations_rad[step];
    for (int k = 0; k < kSides; ++k) {
      const Vec3 level = Eigen::AngleAxisd(2 * std::numbers::pi * k / kSides, base.up) * first;
      const Vec3 eye = base.target + kDistance_m * (std::cos(rad) * level + std::sin(rad) * base.up);
      double cost = 1 - level.dot(familiar_side) + kElevationCost * static_cast<double>(step);
      for (const Shaft& shaft : shafts) {
        const double lean = shaft.towards_handle.dot((eye - base.target).normalized());
        if (presses(shaft, base.target)) cost += kLeanCost * std::max(0.0, lean);
      }
      if (eye.z() < ground_m + kLeastHeight_m) cost += kHiddenCost;
      found.push_back({eye, cost});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return found;
}

// The share of the dent that is hidden from `eye`.
double hidden_share(const Obstacles& obstacles, const Dent& dent, const Camera& base, const Vec3& eye) {
  const Vec3 across = (eye - base.target).cross(base.up).normalized();
  const Vec3 bottom = dent.bottom.cast<double>(), rim = bottom + (dent.depth_m + kAboveRim_m) * base.up;
  const std::array<Vec3, 6> points{base.target,
                                   bottom + kLow_m * base.up,
                                   base.target - kInside_m * across,
                                   base.target + kInside_m * across,
                                   rim - kOutside_m * across,
                                   rim + kOutside_m * across};
  const auto hidden =
      std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return obstacles.hides(p, eye); });
  return static_cast<double>(hidden) / static_cast<double>(points.size());
}

}  // namespace

Camera close_up_of(const Dent& dent, std::span<const MeshData* const> organs, std::span<const Shaft> shafts,
                   const Camera& familiar, double ground_m) {
  const Vec3 normal = dent.outward.cast<double>();
  const Vec3 target = dent.bottom.cast<double>() + kAboveBottom_m * normal;
  Camera best{target, target, normal, kField_deg};
  const Obstacles obstacles(organs, shafts, target);
  double least_cost = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates(best, (familiar.eye - target).normalized(), shafts, ground_m)) {
    if (c.cost >= least_cost) break;  // the others cost more, even if nothing hides the dent from there
    const double cost = c.cost + kHiddenCost * hidden_share(obstacles, dent, best, c.eye);
    if (cost >= least_cost) continue;
    least_cost = cost;
    best.eye = c.eye;
  }
  return best;
}

}  // namespace omentum::render
