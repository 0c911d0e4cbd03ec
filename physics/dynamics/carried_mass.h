// What mass is left on the nodes of a body that loses tetrahedra.
#pragma once

#include "physics/material_map.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// A node loses a quarter of each tetrahedron's mass that goes, as it loses a quarter of its weight: a piece
/// that is cut off falls with g, and swings as the piece that it is. A thousandth stays, so that no node is
/// without mass: M stays positive definite where a node loses its last tetrahedron, or keeps slivers alone.
/// One thread.
class CarriedMass {
 public:
  static constexpr double kLeastShare = 1e-3;

  /// `mass`: [N], kg, with all tetrahedra; nodes may carry more than theirs. `mesh` outlives it.
  CarriedMass(const geometry::TetraMesh& mesh, const MaterialMap& material, std::span<const double> mass);

  /// Precondition: each is there. Allocates nothing.
  void remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  void restore() noexcept;
  /// Nodes that differ carry more from now on, kg[i] of tissue that is around nodes[i]; until restore().
  void give(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept;

  std::span<const double> kg() const noexcept { return mass_; }  // [N]
  /// The nodes that the last remove() took some from, each once, and how much, kg.
  std::span<const geometry::NodeId> lightened() const noexcept { return lightened_; }
  std::span<const double> lost_kg() const noexcept { return lost_; }

 private:
  const geometry::TetraMesh& mesh_;
  std::vector<double> quarter_;      // [T], kg
  std::vector<double> uncut_;        // [N], kg
  std::vector<double> least_;        // [N], kg, what stays
  std::vector<double> mass_;         // [N], kg
  std::vector<std::int32_t> place_;  // [N] among lightened_; -1: not there
  std::vector<geometry::NodeId> lightened_;
  std::vector<double> lost_;
};

}  // namespace omentum::physics
