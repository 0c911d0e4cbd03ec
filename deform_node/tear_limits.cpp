#include "deform_node/tear_limits.h"

#include "geometry/boxes.h"

#include <algorithm>

namespace omentum::deform {

namespace {

using geometry::TetId;
using geometry::Vec3;
using physics::TearLimits;

// What a region leaves out is the organ's.
TearLimits limits_of(const scene::TearSpec& own, const TearLimits& common) {
  return {.volume_change = own.volume_change.value_or(common.volume_change),
          .mean_elongation = own.mean_elongation.value_or(common.mean_elongation),
          .edge_elongation = own.edge_elongation.value_or(common.edge_elongation),
          .stress_pa = own.stress_pa.value_or(common.stress_pa)};
}

Vec3 centre_of(const geometry::TetraMesh& mesh, TetId t) {
  Vec3 sum = Vec3::Zero();
  for (const geometry::NodeId n : mesh.tetrahedra[t]) sum += mesh.positions[n];
  return sum / 4;
}

bool holds(const scene::RegionSpec& region, const geometry::TetraMesh& mesh, TetId t) {
  if (region.label) return !mesh.regions.empty() && mesh.regions[t] == *region.label;
  const Vec3 at = centre_of(mesh, t);
  if (!region.ball.empty()) return (at - Vec3(region.ball.data())).norm() <= region.ball[3];
  return geometry::in_box(at, Vec3(region.box.data()), Vec3(region.box.data() + 3));
}

}  // namespace

std::vector<TearLimits> tear_limits_of(const organ::Organ& organ, const scene::OrganSpec& spec) {
  const geometry::TetraMesh& mesh = organ.mesh;
  const TearLimits common = limits_of(spec.dynamics->tears, {});
  std::vector<TearLimits> limits(mesh.tetrahedra.size(), common);
  for (const scene::RegionSpec& region : spec.regions) {
    const TearLimits own = limits_of(region.tears, common);
    for (std::size_t t = 0; t < limits.size(); ++t)
      if (holds(region, mesh, TetId(t))) limits[t] = own;
  }
  return limits;
}

}  // namespace omentum::deform
