// Precomputation of the force tensors for all surface nodes (Cotin 1999, section 4-1), in their symmetric
// form C = K^-1.
#pragma once

#include "physics/compliance_tiles.h"
#include "physics/stiffness_factor.h"

#include <functional>

namespace omentum::physics {

struct TensorOptions {
  int threads = 1;  // workers over blocks of columns; they share the factor
  std::function<void(double fraction)>
      on_progress;                // called by one worker at a time, from 0 to 1; may be empty
  std::function<bool()> stopped;  // asked by all workers between blocks; may be empty
  // Called by all workers for tiles that are not needed again soon: a mapped file may let their pages go. May
  // be empty.
  std::function<void(const void* begin, std::size_t bytes)> on_idle;
};

/// Fills `tiles` with C_nk for all mobile surface nodes, and `bounds` ([mobile][clusters], as
/// SurfaceCompliance has them). Held components and unused lanes are zero; C_kn = C_nk^T exactly. Memory
/// beyond the tiles: the factor, and per worker 48 to 129 doubles per degree of freedom. Sets OpenBLAS to one
/// thread meanwhile. Returns false when it was stopped: then the tiles are incomplete. `Scalar` is float or
/// double.
template <class Scalar>
[[nodiscard]] bool compute_force_tensors(const StiffnessFactor& factor, const FreeDofs& free,
                                         const geometry::Surface& surface,
                                         const ComplianceTiles<Scalar>& tiles, std::span<float> bounds,
                                         const TensorOptions& options);

}  // namespace omentum::physics
