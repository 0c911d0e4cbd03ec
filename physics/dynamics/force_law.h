// How the nodes of a mesh answer to their displacements: the one interface that time integrators know.
#pragma once

#include "geometry/types.h"

#include <span>

namespace omentum::physics {

/// An elastic body over all N nodes of a mesh. Displacements u are from rest, m, forces f on the nodes in N:
/// [3 N], x y z of each node in the mesh's order. One thread at a time; no call allocates.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// f = -dE/du, overwritten, also at nodes that are held.
  virtual void forces(std::span<const double> u, std::span<double> f) noexcept = 0;

  /// E, J: zero at rest.
  virtual double energy(std::span<const double> u) const noexcept = 0;

  /// Takes one tetrahedron's share out, or puts it back. Callers keep count: each is removed once at most,
  /// and added only when it was removed.
  virtual void remove(geometry::TetId t) noexcept = 0;
  virtual void add(geometry::TetId t) noexcept = 0;
};

}  // namespace omentum::physics
