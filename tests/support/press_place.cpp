#include "tests/support/press_place.h"

#include "geometry/closest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace omentum::test {
namespace {

using geometry::SurfaceId;
using geometry::Vec3;

constexpr int kDirections = 8;
constexpr double kToolRadius_m = 4e-3;  // the scene's probe reaches so far beside its tip
constexpr double kShortest_m = 4e-3, kShorter_m = 2e-3, kSampleEvery_m = 1e-3;
constexpr double kUpperSide = 0.3;  // least cosine between an upper node's normal and up
constexpr double kLeaning = 0.5;    // least cosine between the normals around a place and its own
// A surface that falls away by more than half of the deepest press lets the tool out of a slide.
constexpr double kUneven_m = 4e-3;
// Linear elasticity means something where a press is less than a third of the organ.
constexpr double kThin_m = 24e-3;
// Beyond this above or below the plane a node belongs to another side of the organ, m.
constexpr double kLayer_m = 20e-3;

std::vector<Vec3> normals_of(const haptic::ElasticSurface& organ) {
  std::vector<Vec3> normals(organ.rest.size(), Vec3::Zero());
  for (const geometry::Triangle& t : organ.surface.triangles) {
    const Vec3& a = organ.rest[t[0]];
    const Vec3 area = (organ.rest[t[1]] - a).cross(organ.rest[t[2]] - a);
    for (const SurfaceId s : t) normals[s] += area;
  }
  for (Vec3& n : normals) n.normalize();
  return normals;
}

// Heights over `p` along `up` at which the line through p meets the surface.
std::vector<double> crossings(const haptic::ElasticSurface& organ, const Vec3& p, const Vec3& up) {
  constexpr double kFar_m = 0.5;
  std::vector<double> heights;
  for (const geometry::Triangle& t : organ.surface.triangles) {
    const auto hit = geometry::intersect_segment_triangle(p - kFar_m * up, p + kFar_m * up, organ.rest[t[0]],
                                                          organ.rest[t[1]], organ.rest[t[2]]);
    if (hit) heights.push_back((2 * hit->parameter - 1) * kFar_m);
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

struct Candidate {
  SurfaceId node;
  double unevenness_m;
};

// Mobile nodes with nothing but gentle mobile surface in a cylinder around them, the flattest first.
std::vector<Candidate> candidates(const haptic::ElasticSurface& organ, const std::vector<Vec3>& normals,
                                  const Vec3& up, double radius_m) {
  std::vector<Candidate> found;
  for (SurfaceId s(0); s < organ.surface.mobile_count; s = SurfaceId(s + 1)) {
    if (normals[s].dot(up) < kUpperSide) continue;
    double uneven_m = 0;
    for (SurfaceId other(0); other < organ.surface.node_count() && uneven_m <= kUneven_m;
         other = SurfaceId(other + 1)) {
      const Vec3 way = organ.rest[other] - organ.rest[s];
      const double height = way.dot(normals[s]);
      if ((way - height * normals[s]).norm() > radius_m || std::abs(height) > kLayer_m) continue;
      const bool gentle = normals[other].dot(normals[s]) > kLeaning && other < organ.surface.mobile_count;
      uneven_m = gentle ? std::max(uneven_m, std::abs(height)) : std::numeric_limits<double>::infinity();
    }
    if (uneven_m <= kUneven_m) found.push_back({s, uneven_m});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.unevenness_m < b.unevenness_m; });
  return found;
}

// Looks at every slide from above; false when one leaves the organ.
bool measure(const haptic::ElasticSurface& organ, PressPlace& place) {
  std::vector<double> below = crossings(organ, place.point - 1e-6 * place.normal, -place.normal);
  below.erase(below.begin(), std::find_if(below.begin(), below.end(), [](double h) { return h > 0; }));
  place.thickness_m = below.empty() ? 0 : below.front();
  if (place.thickness_m < kThin_m) return false;
  for (int d = 0; d < kDirections; ++d) {
    for (double s = kSampleEvery_m; s <= place.slide_m; s += kSampleEvery_m) {
      const auto heights =
          crossings(organ, place.point + s * place.direction(360.0 * d / kDirections), place.normal);
      if (heights.empty()) return false;
      place.rise_m = std::max(place.rise_m, heights.back());
      place.fall_m = std::max(place.fall_m, -heights.back());
    }
  }
  return place.rise_m <= kUneven_m && place.fall_m <= kUneven_m;
}

}  // namespace

Vec3 PressPlace::direction(double degrees) const {
  Vec3 along = Vec3::UnitX() - normal.x() * normal;
  if (along.norm() < 0.1) along = Vec3::UnitY() - normal.y() * normal;
  along.normalize();
  const double turn = degrees * std::numbers::pi / 180;
  return std::cos(turn) * along + std::sin(turn) * normal.cross(along);
}

std::optional<PressPlace> find_press_place(const haptic::ElasticSurface& organ, const Vec3& up,
                                           double slide_m) {
  const std::vector<Vec3> normals = normals_of(organ);
  for (; slide_m >= kShortest_m; slide_m -= kShorter_m) {
    for (const Candidate& candidate : candidates(organ, normals, up, slide_m + kToolRadius_m)) {
      PressPlace place{organ.rest[candidate.node], normals[candidate.node], slide_m};
      if (measure(organ, place)) return place;
    }
  }
  return std::nullopt;
}

}  // namespace omentum::test
