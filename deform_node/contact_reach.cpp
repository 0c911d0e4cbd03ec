#include "deform_node/contact_reach.h"

#include "geometry/boxes.h"

#include <algorithm>
#include <array>

namespace omentum::deform {

double largest_displacement_m(const physics::SurfaceCompliance& compliance, std::span<const SurfaceId> nodes,
                              std::span<const Vec3> forces) noexcept {
  constexpr int kLanes = physics::SurfaceCompliance::kLanes;
  alignas(64) std::array<float, 3 * kLanes> u{};
  std::int32_t filled = -1;  // the cluster that u holds
  double largest_squared = 0;
  for (const SurfaceId node : nodes) {
    const std::int32_t cluster = static_cast<std::int32_t>(node) / kLanes, lane = node % kLanes;
    if (cluster != filled) physics::superpose_cluster(compliance, cluster, nodes, forces, u.data());
    filled = cluster;
    const Vec3 moved(u[lane], u[kLanes + lane], u[2 * kLanes + lane]);
    largest_squared = std::max(largest_squared, moved.squaredNorm());
  }
  return std::sqrt(largest_squared);
}

double reach_of(std::span<const Vec3> rest) noexcept {
  return geometry::diagonal_around(rest);
}

}  // namespace omentum::deform
