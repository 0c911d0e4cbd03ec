// How far a surface is stretched along itself: all that is known of a body whose inside is not.
#pragma once

#include "geometry/surface.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// At each node the larger one of the two principal strains lambda - 1 of its triangles, mean by their areas
/// at rest: lambda^2 are the eigenvalues of F^T F with F the map from a triangle's plane at rest to where it
/// is. Rigid motion gives 0. What happens across the surface is not in it. No allocation after construction;
/// one thread at a time.
class MembraneStrain {
 public:
  /// `rest`: [S], m, in the surface's order. Both must outlive this.
  MembraneStrain(const geometry::Surface& surface, const std::vector<geometry::Vec3>& rest);

  /// `displacements`: [3S], m; `strain`: [S]; 0 where a node has no triangle.
  void measure(std::span<const float> displacements, std::span<float> strain) noexcept;

 private:
  const geometry::Surface& surface_;
  const std::vector<geometry::Vec3>& rest_;
  std::vector<double> sum_, area_m2_;  // workspace, [S]
};

}  // namespace omentum::physics
