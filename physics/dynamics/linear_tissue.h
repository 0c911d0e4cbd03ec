// Tetrahedra of a body that follow the linear law while others turn.
#pragma once

#include "physics/stiffness.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// f = K u of some tetrahedra of a mesh, in sparse blocks. A node is tied by those that are left of them.
/// Vectors are [3N]. All memory is taken at construction; one thread at a time.
class LinearTissue {
 public:
  /// `chosen`: [T] other than 0; empty: none. `mesh` outlives it.
  LinearTissue(const geometry::TetraMesh& mesh, const MaterialMap& material,
               std::span<const std::uint8_t> chosen);

  /// f += scale K u, N.
  void add_product(double scale, std::span<const double> u, std::span<double> f) noexcept;
  /// u^T K u / 2, J.
  double energy(std::span<const double> u) noexcept;

  bool has(geometry::TetId t) const noexcept { return !has_.empty() && has_[t] != 0; }
  /// Whether it was chosen, there or not.
  bool had(geometry::TetId t) const noexcept { return !chosen_.empty() && chosen_[t] != 0; }
  /// Whether what is left of it is around a node.
  bool ties(geometry::NodeId n) const noexcept { return !ties_.empty() && ties_[n] > 0; }
  /// Precondition: it is there.
  void remove(geometry::TetId t) noexcept;
  void restore() noexcept;

 private:
  void count_ties() noexcept;

  const geometry::TetraMesh& mesh_;
  MaterialMap material_;
  std::vector<std::uint8_t> chosen_, has_;  // [T]; empty: none
  std::vector<std::int32_t> ties_;          // [N] tetrahedra that are left around it
  Stiffness stiffness_;                     // of what is left; of no node where none was chosen
  std::vector<Eigen::Matrix3d> uncut_;      // its blocks
  std::vector<double> f_;                   // [3N]
};

}  // namespace omentum::physics
