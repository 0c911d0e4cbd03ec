#include "organ_tools/scene_prepare/organ_skin.h"

#include "geometry/boxes.h"
#include "geometry/closest_points.h"

#include <algorithm>
#include <limits>

namespace omentum::scene_prepare {

namespace {

Vec3 mean(const std::vector<Vec3>& x) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : x) sum += p;
  return x.empty() ? sum : Vec3(sum / static_cast<double>(x.size()));
}

}  // namespace

OrganSkin::OrganSkin(const organ::Organ& organ)
    : surface_(organ.surface),
      positions_(geometry::surface_positions(organ.mesh, organ.surface)),
      normals_(geometry::surface_normals(surface_, positions_)),
      centre_(mean(positions_)),
      support_centre_(centre_),
      diagonal_(geometry::diagonal_around(positions_)) {
  measure_supports(organ);
}

void OrganSkin::measure_supports(const organ::Organ& organ) {
  std::vector<Vec3> supports, rollers;
  for (std::size_t n = 0; n < organ.fixed.size(); ++n)
    if (organ.fixed[n] == physics::kPinned) supports.push_back(organ.mesh.positions[n]);
  // rollers count where nothing is held altogether
  for (std::size_t n = 0; supports.empty() && n < organ.fixed.size(); ++n)
    if (organ.fixed[n] != 0) rollers.push_back(organ.mesh.positions[n]);
  if (supports.empty()) supports = std::move(rollers);
  if (!supports.empty()) support_centre_ = mean(supports);
  support_distance_.assign(positions_.size(), diagonal_);
  for (std::size_t s = 0; s < positions_.size(); ++s)
    for (const Vec3& p : supports)
      support_distance_[s] = std::min(support_distance_[s], (p - positions_[s]).norm());
}

std::vector<SurfaceId> OrganSkin::patch(SurfaceId s, double radius_m) const {
  std::vector<SurfaceId> found{s};
  std::vector<bool> seen(positions_.size(), false);
  seen[s] = true;
  for (std::size_t next = 0; next < found.size(); ++next)
    for (const TriangleId t : surface_.triangles_of(found[next]))
      for (const SurfaceId neighbour : surface_.triangles[t]) {
        if (seen[neighbour] || (positions_[neighbour] - positions_[s]).norm() > radius_m) continue;
        seen[neighbour] = true;
        found.push_back(neighbour);
      }
  return found;
}

void OrganSkin::consider(TriangleId triangle, const Vec3& p, Candidate& best) const {
  const geometry::Triangle& t = surface_.triangles[triangle];
  const geometry::TrianglePoint hit =
      geometry::closest_point_on_triangle(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
  if (hit.squared_distance >= best.squared_distance) return;
  best.squared_distance = hit.squared_distance;
  best.point = {Vec3::Zero(), Vec3::Zero()};
  for (int v = 0; v < 3; ++v) {
    best.point.position += hit.barycentric[v] * positions_[t[v]];
    best.point.normal += hit.barycentric[v] * normals_[t[v]];
  }
  best.point.normal.normalize();
}

SkinPoint OrganSkin::closest(const Vec3& p) const {
  Candidate best{std::numeric_limits<double>::infinity(), {}};
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    const geometry::Triangle& nodes = surface_.triangles[t];
    if (std::all_of(nodes.begin(), nodes.end(), [this](SurfaceId s) { return mobile(s); }))
      consider(TriangleId(t), p, best);
  }
  return best.point;
}

SkinPoint OrganSkin::closest(const Vec3& p, std::span<const SurfaceId> patch) const {
  Candidate best{std::numeric_limits<double>::infinity(), {}};
  for (const SurfaceId s : patch)
    for (const TriangleId t : surface_.triangles_of(s)) consider(t, p, best);
  return best.point;
}

double OrganSkin::thickness(const SkinPoint& at) const {
  // starts below the surface, so that the triangle it stands on is not met
  const double skipped = 1e-3 * diagonal_;
  const Vec3 from = at.position - skipped * at.normal;
  const Vec3 to = at.position - diagonal_ * at.normal;
  double nearest = 1;
  for (const geometry::Triangle& t : surface_.triangles) {
    const auto hit =
        geometry::intersect_segment_triangle(from, to, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
    if (hit) nearest = std::min(nearest, hit->parameter);
  }
  return skipped + nearest * (diagonal_ - skipped);
}

}  // namespace omentum::scene_prepare
