#include "physics/surface_compliance.h"

#include "geometry/precondition.h"
#include "physics/superpose_kernels.h"

#include <algorithm>

namespace omentum::physics {

static_assert(kernels::kLanes == SurfaceCompliance::kLanes &&
              kernels::kTile == SurfaceCompliance::kTileFloats);

namespace {

// Columns in the form that the kernels read: pointers and float forces, on the stack.
struct ColumnBatch {
  const float* columns[kernels::kMaxColumns];
  float forces[3 * kernels::kMaxColumns];
  int count = 0;

  ColumnBatch(const SurfaceCompliance& compliance, std::int32_t cluster, std::span<const SurfaceId> nodes,
              std::span<const Vec3> node_forces) {
    for (std::size_t q = 0; q < nodes.size(); ++q, ++count) {
      geometry::require(nodes[q] >= 0 && nodes[q] < compliance.mobile_count(), "mobile nodes");
      columns[q] = compliance.tile(nodes[q], cluster);
      for (int j = 0; j < 3; ++j) forces[3 * q + j] = static_cast<float>(node_forces[q][j]);
    }
  }
};

// u over `clusters` tiles from `first` on, a batch of columns at a time.
void superpose(const SurfaceCompliance& compliance, std::int32_t first, std::size_t clusters,
               std::span<const SurfaceId> nodes, std::span<const Vec3> forces, float* u) noexcept {
  geometry::require(nodes.size() == forces.size(), "a force for each node");
  bool accumulate = false;
  do {
    const std::size_t count = std::min<std::size_t>(nodes.size(), kernels::kMaxColumns);
    const ColumnBatch batch(compliance, first, nodes.first(count), forces.first(count));
    kernels::superpose_columns(batch.columns, batch.forces, batch.count, clusters, accumulate, u);
    nodes = nodes.subspan(count);
    forces = forces.subspan(count);
    accumulate = true;
  } while (!nodes.empty());
}

}  // namespace

SurfaceCompliance::SurfaceCompliance(std::int32_t mobile_count, const float* tiles, const float* bounds,
                                     std::shared_ptr<const void> keep_alive)
    : mobile_count_(mobile_count),
      cluster_count_((mobile_count + kLanes - 1) / kLanes),
      tiles_(tiles),
      bounds_(bounds),
      keep_alive_(std::move(keep_alive)) {}

Eigen::Matrix3d SurfaceCompliance::block(SurfaceId n, SurfaceId k) const {
  Eigen::Matrix3d C_nk = Eigen::Matrix3d::Zero();
  if (!n.valid() || !k.valid() || n >= mobile_count_ || k >= mobile_count_) return C_nk;
  const float* lane = tile(k, n / kLanes) + n % kLanes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) C_nk(i, j) = lane[(3 * i + j) * kLanes];
  }
  return C_nk;
}

void superpose_cluster(const SurfaceCompliance& compliance, std::int32_t cluster,
                       std::span<const SurfaceId> nodes, std::span<const Vec3> forces, float* u) noexcept {
  superpose(compliance, cluster, 1, nodes, forces, u);
}

void superpose_surface(const SurfaceCompliance& compliance, std::span<const SurfaceId> nodes,
                       std::span<const Vec3> forces, std::span<float> u) noexcept {
  const auto clusters = static_cast<std::size_t>(compliance.cluster_count());
  geometry::require(u.size() >= 3 * SurfaceCompliance::kLanes * clusters, "room for every cluster");
  superpose(compliance, 0, clusters, nodes, forces, u.data());
}

}  // namespace omentum::physics
