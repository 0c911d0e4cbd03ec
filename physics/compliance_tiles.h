// The memory of a SurfaceCompliance while it is filled, and in double precision.
#pragma once

#include "geometry/surface.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// A view of tiles in the layout of SurfaceCompliance: [mobile][clusters][9][16] of `Scalar` (float or
/// double, const to read). The memory is somebody else's.
template <class Scalar>
struct ComplianceTiles {
  static constexpr int kLanes = geometry::kClusterSize;
  static constexpr int kTileSize = 9 * kLanes;

  std::int32_t mobile_count = 0;
  Scalar* values = nullptr;

  std::int32_t cluster_count() const { return (mobile_count + kLanes - 1) / kLanes; }
  /// Scalars of all tiles together.
  std::size_t size() const { return std::size_t(mobile_count) * cluster_count() * kTileSize; }
  Scalar* tile(std::int32_t k, std::int32_t cluster) const {
    return values + (std::size_t(k) * cluster_count() + cluster) * kTileSize;
  }
  /// Component i of node n per unit force along j at node k.
  Scalar& at(std::int32_t n, int i, std::int32_t k, int j) const {
    return tile(k, n / kLanes)[(3 * i + j) * kLanes + n % kLanes];
  }
};

/// Copies C_nk into C_kn = C_nk^T for the pairs of clusters (c, c') with c' <= c of one c, wherever rank[n] >
/// rank[k]: columns are computed from their own rank on. `rank`: [mobile], all different. Different c may run
/// in parallel.
template <class Scalar>
void mirror_cluster(const ComplianceTiles<Scalar>& tiles, std::span<const std::int32_t> rank,
                    std::int32_t cluster);

/// For each cluster the mobile nodes of every triangle that touches it: what SurfaceCompliance::bounds
/// promises to hold for.
struct ClusterReach {
  std::vector<std::int32_t> start;  // [clusters + 1]
  std::vector<std::int32_t> nodes;
};

ClusterReach cluster_reach(const geometry::Surface& surface);

/// The bounds of column k, [clusters], m/N. `scratch`: [clusters * 16].
template <class Scalar>
void bound_column(const ComplianceTiles<Scalar>& tiles, const ClusterReach& reach, std::int32_t k,
                  float* bounds, std::span<float> scratch);

}  // namespace omentum::physics
