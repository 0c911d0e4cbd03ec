// What happens inside a precomputed part, of which only the surface has tensors.
#pragma once

#include "geometry/surface.h"
#include "physics/dynamics/kept_factor.h"
#include "physics/hybrid/mesh_split.h"

namespace omentum::physics {

/// The inside follows the surface elastically: K_II u_I = f_I - K_IS u_S, one solve on a kept factor. For
/// whoever needs it and has the time; a step does not. All memory is taken at construction; one thread at a
/// time.
class InnerNodes {
 public:
  /// `part` outlives this; `surface` is its own, `fixed` [n] its supports, `weights` [3N] what always acts on
  /// the whole, N. Throws as KeptFactor does.
  InnerNodes(const MeshPart& part, const geometry::Surface& surface, const FixedComponents& fixed,
             const MaterialMap& material, std::span<const double> weights);

  /// Sets the part's inner nodes in `u`, [3N] of the whole, m, by those of its surface.
  void follow(std::span<double> u) noexcept;

 private:
  const MeshPart& part_;
  std::vector<bool> is_inner_;  // [n]
  KeptFactor factor_;
  std::vector<double> weights_, own_, lacking_;  // [3n]
};

}  // namespace omentum::physics
