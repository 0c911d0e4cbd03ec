// The precomputed force tensors in the form that a haptic step reads: the symmetric compliance of
// the mobile surface nodes (docs/design.md, "Compliance"): f_A = C_AA^-1 u*, u = C_:A f_A.
#pragma once

#include "geometry/surface.h"

#include <memory>
#include <span>
#include <vector>

namespace omentum::physics {

using geometry::SurfaceId;
using geometry::Vec3;

/// C_nk, m/N: the displacement of surface node n per unit force at surface node k, all other mobile
/// nodes free. Only nodes below mobile_count are stored; the others never move.
///
/// Layout, chosen for the cache: for each column node k, its clusters one after the other; for each cluster
/// (16 consecutive n) nine planes of 16 floats. Entry (3*i + j) of a tile's lane l is component i
/// of the displacement of node 16*cluster + l per unit force along j at k. 576 bytes a tile, 64-byte
/// aligned; lanes past mobile_count are zero. Read-only after construction: any thread may read.
class SurfaceCompliance {
 public:
  static constexpr int kLanes = geometry::kClusterSize;
  static constexpr int kTileFloats = 9 * kLanes;

  /// `tiles`: [mobile][clusters][9][16]; `bounds`: [mobile][clusters]. `keep_alive` owns the memory
  /// (a vector or a mapped file: shared so that the organ file is mapped once and outlives its reader).
  SurfaceCompliance(std::int32_t mobile_count, const float* tiles, const float* bounds,
                    std::shared_ptr<const void> keep_alive);

  std::int32_t mobile_count() const { return mobile_count_; }
  std::int32_t cluster_count() const { return cluster_count_; }

  const float* tile(SurfaceId k, std::int32_t cluster) const {
    return tiles_ + (static_cast<std::size_t>(k) * cluster_count_ + cluster) * kTileFloats;
  }

  /// C_nk as a 3x3 matrix; zero where n or k is not mobile.
  Eigen::Matrix3d block(SurfaceId n, SurfaceId k) const;

  /// Upper bounds of |C_nk|_2, [clusters] for column k, m/N: entry c holds for every node of every
  /// triangle that touches cluster c, so that sum_k bound * |f_k| bounds how far those triangles moved.
  std::span<const float> bounds(SurfaceId k) const {
    return {bounds_ + static_cast<std::size_t>(k) * cluster_count_, static_cast<std::size_t>(cluster_count_)};
  }

 private:
  std::int32_t mobile_count_;
  std::int32_t cluster_count_;
  const float* tiles_;
  const float* bounds_;
  std::shared_ptr<const void> keep_alive_;
};

/// Displacements of one cluster under the forces f_k at the nodes k: u = sum_k C_:k f_k (Cotin 1999
/// eq. 9 in force form). `u`: [3][16] floats, overwritten, m. `nodes` and `forces` (N) have equal length;
/// nodes must be mobile. No allocation; vectorized over the 16 lanes.
void superpose_cluster(const SurfaceCompliance& compliance, std::int32_t cluster,
                       std::span<const SurfaceId> nodes, std::span<const Vec3> forces, float* u) noexcept;

/// The whole surface: `u` is [3 * clusters * 16] floats laid out [cluster][3][16], overwritten, m.
void superpose_surface(const SurfaceCompliance& compliance, std::span<const SurfaceId> nodes,
                       std::span<const Vec3> forces, std::span<float> u) noexcept;

}  // namespace omentum::physics
