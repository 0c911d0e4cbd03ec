// How a patch of an intestine's skin yields.
#pragma once

#include "geometry/gut_skin.h"
#include "physics/intestine/gut_system.h"

#include <array>
#include <span>
#include <vector>

namespace omentum::deform {

/// C = J A^-1 J^T + wall, alike in all directions: J has the weights by which masses carry nodes of the skin,
/// A^-1 is what the masses yield within a step of `gut`, m/N. Memory is taken at construction; one thread at
/// a time.
class GutCompliance {
 public:
  /// `skin` outlives it. `wall_m_n`: what a place of the skin yields beside the masses.
  GutCompliance(const geometry::GutSkin& skin, double wall_m_n, std::size_t most_nodes);

  /// The upper triangle of C of these nodes, [3n x 3n], row by row.
  void find(const physics::GutSystem& gut, std::span<const geometry::NodeId> nodes,
            std::span<float> upper) noexcept;

 private:
  using Places = std::array<std::size_t, geometry::GutSkin::kMostWeights>;

  void find_masses(std::span<const geometry::NodeId> nodes) noexcept;
  double between(std::span<const geometry::NodeId> nodes, std::size_t i, std::size_t j) const noexcept;

  const geometry::GutSkin& skin_;
  double wall_m_n_;
  std::vector<geometry::MassId> masses_;  // that carry the patch
  std::vector<Places> place_of_;          // [n] among these, of each weight
  std::vector<double> block_;             // A^-1 of these
};

}  // namespace omentum::deform
