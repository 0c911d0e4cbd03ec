// What of a factor has to change when tetrahedra go that nodes without masses hang on.
#pragma once

#include "geometry/remaining_tetrahedra.h"
#include "physics/material_map.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// How tetrahedra leave a factor.
struct PartedTetrahedra {
  std::span<const geometry::TetId> taken;   // off it
  std::span<const geometry::TetId> whole;   // go with all their nodes: they stay in it, tied to nothing
  std::span<const geometry::NodeId> loose;  // to be anchored before: else something would be singular
};

/// Books of what is left. A node that loses its last tetrahedron has to be anchored. A part that goes as a
/// whole may stay in the factor, anchored at four nodes, since nothing ties it to the rest any more: so a
/// part of any size goes at once. All memory is taken at construction; one thread at a time.
class Parting {
 public:
  /// `mesh` outlives it.
  explicit Parting(const geometry::TetraMesh& mesh);

  Parting(const Parting&) = delete;  // its books refer to each other
  Parting& operator=(const Parting&) = delete;

  /// Precondition: each is there. Valid until the next call; what was anchored before is not loose again.
  PartedTetrahedra part(std::span<const geometry::TetId> gone) noexcept;
  /// These are anchored by somebody else.
  void settle(std::span<const geometry::NodeId> nodes) noexcept;
  void restore() noexcept;

  /// The sum of `each`, [T], over the tetrahedra that are left around a node.
  double sum_around(geometry::NodeId n, std::span<const double> each) const noexcept;

 private:
  void keep_piece(geometry::TetId first) noexcept;
  void anchor(geometry::NodeId n) noexcept;

  geometry::TetraLinks links_;
  geometry::RemainingTetrahedra left_;
  std::vector<geometry::TetId> taken_, whole_, piece_;   // of this call, capacity T
  std::vector<geometry::NodeId> loose_;                  // likewise, capacity N
  enum class Stay : std::uint8_t { kNo, kFound, kYes };  // kFound: not yet of a piece
  std::vector<Stay> stays_;                              // [T] of what is gone: in the factor all the same
  std::vector<bool> is_settled_;                         // [N] anchored, or of a piece that is
};

/// What an anchor answers beside a body's own stiffness, in each direction, N/m: a mean of K's diagonal.
double anchor_stiffness(const geometry::TetraMesh& mesh, const MaterialMap& material);

}  // namespace omentum::physics
