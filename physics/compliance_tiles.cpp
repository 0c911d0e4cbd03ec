#include "physics/compliance_tiles.h"

#include "physics/superpose_kernels.h"

#include <algorithm>
#include <type_traits>

namespace omentum::physics {

namespace {

using geometry::kClusterSize;

// C_kn = C_nk^T for one pair of lanes: `from` is lane n of a tile of column k, `to` lane k of one of column
// n.
template <class Scalar>
void transpose_lane(const Scalar* from, Scalar* to) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) to[(3 * j + i) * kClusterSize] = from[(3 * i + j) * kClusterSize];
  }
}

// C_nn = C_nn^T: its two triangles come from different columns and differ by rounding.
template <class Scalar>
void symmetrize_lane(Scalar* lane) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) lane[(3 * i + j) * kClusterSize] = lane[(3 * j + i) * kClusterSize];
  }
}

}  // namespace

template <class Scalar>
void mirror_cluster(const ComplianceTiles<Scalar>& tiles, std::span<const std::int32_t> rank,
                    std::int32_t cluster) {
  const std::int32_t n_end = std::min((cluster + 1) * kClusterSize, tiles.mobile_count);
  for (std::int32_t other = 0; other <= cluster; ++other) {
    const std::int32_t k_end = std::min((other + 1) * kClusterSize, tiles.mobile_count);
    for (std::int32_t n = cluster * kClusterSize; n < n_end; ++n) {
      for (std::int32_t k = other * kClusterSize; k < std::min(k_end, n); ++k) {
        Scalar* const nk = tiles.tile(k, cluster) + n % kClusterSize;
        Scalar* const kn = tiles.tile(n, other) + k % kClusterSize;
        if (rank[n] > rank[k]) {
          transpose_lane(nk, kn);
        } else {
          transpose_lane(kn, nk);
        }
      }
      if (other == cluster) symmetrize_lane(tiles.tile(n, cluster) + n % kClusterSize);
    }
  }
}

ClusterReach cluster_reach(const geometry::Surface& surface) {
  const std::int32_t clusters = (surface.mobile_count + kClusterSize - 1) / kClusterSize;
  std::vector<std::vector<std::int32_t>> reach(clusters);
  for (const auto& triangle : surface.triangles) {
    for (const auto touched : triangle) {
      if (touched >= surface.mobile_count) continue;
      for (const auto n : triangle) {
        if (n < surface.mobile_count) reach[touched / kClusterSize].push_back(n);
      }
    }
  }
  ClusterReach result{{0}, {}};
  for (auto& nodes : reach) {
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    result.start.push_back(static_cast<std::int32_t>(result.nodes.size()));
  }
  return result;
}

template <class Scalar>
void bound_column(const ComplianceTiles<Scalar>& tiles, const ClusterReach& reach, std::int32_t k,
                  float* bounds, std::span<float> scratch) {
  using Tiles = ComplianceTiles<Scalar>;
  for (std::int32_t c = 0; c < tiles.cluster_count(); ++c) {
    if constexpr (std::is_same_v<std::remove_const_t<Scalar>, float>) {
      kernels::bound_tile(tiles.tile(k, c), &scratch[c * kClusterSize]);
    } else {
      float rounded[Tiles::kTileSize];
      std::copy_n(tiles.tile(k, c), Tiles::kTileSize, rounded);
      kernels::bound_tile(rounded, &scratch[c * kClusterSize]);
    }
  }
  for (std::int32_t c = 0; c < tiles.cluster_count(); ++c) {
    float bound = 0;
    for (std::int32_t r = reach.start[c]; r < reach.start[c + 1]; ++r) {
      bound = std::max(bound, scratch[reach.nodes[r]]);
    }
    bounds[c] = bound;
  }
}

template void mirror_cluster(const ComplianceTiles<float>&, std::span<const std::int32_t>, std::int32_t);
template void mirror_cluster(const ComplianceTiles<double>&, std::span<const std::int32_t>, std::int32_t);
template void bound_column(const ComplianceTiles<float>&, const ClusterReach&, std::int32_t, float*,
                           std::span<float>);
template void bound_column(const ComplianceTiles<double>&, const ClusterReach&, std::int32_t, float*,
                           std::span<float>);

}  // namespace omentum::physics
