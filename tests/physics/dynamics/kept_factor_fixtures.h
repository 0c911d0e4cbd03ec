// Bodies whose implicit systems are kept, and what they must equal.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/kept_factor.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <random>

namespace omentum::test {

inline constexpr physics::Material kTissue{5000, 0.45, 1050};

/// Held on one side, and at one more node in one component.
struct HeldBody {
  geometry::TetraMesh mesh;
  physics::Inertia inertia;

  explicit HeldBody(geometry::TetraMesh of, double held_part = 0.05) : mesh(std::move(of)) {
    double low = mesh.positions[0].x(), high = low;
    for (const geometry::Vec3& p : mesh.positions) low = std::min(low, p.x()), high = std::max(high, p.x());
    for (const geometry::Vec3& p : mesh.positions)
      inertia.fixed.push_back(p.x() <= low + held_part * (high - low) ? physics::kPinned : 0);
    inertia.fixed.back() |= 2;
    inertia.mass = physics::lumped_masses(mesh, kTissue);
  }

  std::size_t components() const { return 3 * mesh.positions.size(); }
  bool held(std::size_t c) const { return physics::is_fixed(inertia.fixed[c / 3], static_cast<int>(c % 3)); }

  /// All tetrahedra, shuffled.
  std::vector<geometry::TetId> any_order() const {
    std::vector<geometry::TetId> order;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) order.emplace_back(t);
    std::ranges::shuffle(order, std::mt19937(7));
    return order;
  }

  /// K of all tetrahedra but `removed`, assembled anew.
  physics::Stiffness stiffness_without(std::span<const geometry::TetId> removed) const {
    std::vector<bool> gone(mesh.tetrahedra.size());
    for (const geometry::TetId t : removed) gone[t] = true;
    physics::Stiffness K = physics::assemble_stiffness(mesh, kTissue);
    for (auto& block : K.block) block.setZero();
    for (std::size_t t = 0; t < gone.size(); ++t) {
      if (gone[t]) continue;
      const auto element = physics::element_tensors(physics::corners_of(mesh, geometry::TetId(t)), kTissue);
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t k = 0; k < 4; ++k)
          block(K, mesh.tetrahedra[t][j], mesh.tetrahedra[t][k]) += element[j][k];
      }
    }
    return K;
  }

  /// m M + k K of what is left.
  physics::Stiffness system_without(std::span<const geometry::TetId> removed,
                                    const physics::SystemWeights& weights) const {
    physics::Stiffness A = stiffness_without(removed);
    for (auto& block : A.block) block *= weights.stiffness;
    for (std::size_t n = 0; n < inertia.mass.size(); ++n) {
      const geometry::NodeId node(n);
      block(A, node, node).diagonal().array() += weights.mass * inertia.mass[n];
    }
    return A;
  }

 private:
  static Eigen::Matrix3d& block(physics::Stiffness& K, geometry::NodeId row, geometry::NodeId column) {
    std::int32_t b = K.start[row];
    while (K.neighbour[b] != column) ++b;
    return K.block[b];
  }
};

inline HeldBody held_box() {
  return HeldBody(make_box_mesh(6, 4, 5, {0.06, 0.05, 0.04}));
}

}  // namespace omentum::test
