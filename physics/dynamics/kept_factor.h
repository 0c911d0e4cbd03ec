// The factor of an implicit step, kept while tetrahedra are removed.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/factor_downdate.h"
#include "physics/dynamics/inverse_columns.h"
#include "physics/dynamics/known_blocks.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace omentum::physics {

/// What A = m M + k K is made of.
struct SystemWeights {
  double mass = 1;       // m, of the lumped masses
  double stiffness = 1;  // k, s^2
};

/// Those of a step of backward Euler of length `dt` (s) with Rayleigh damping: A = M + dt D + dt^2 K.
inline SystemWeights weights_of(const Inertia& inertia, double dt) {
  return {1 + dt * inertia.mass_damping_per_s, dt * dt + dt * inertia.stiffness_damping_s};
}

/// A = m M + k K over the free degrees of freedom, factorized once: L D L^T by CHOLMOD, in panels of its own
/// (factor_panels.h) that are solved with in float and downdated in double. A tetrahedron's stiffness has
/// rank six; its mass stays on the nodes until take_mass(), so that A stays positive definite even where a
/// node loses its last one. Vectors are [3N], x y z of each node in the mesh's order; held components of
/// results are zero.
///
/// All memory is taken at construction; one thread at a time.
class KeptFactor {
 public:
  /// `mass`: [N], kg, not negative; `added` is a part of K that no removal takes. Throws FloatingError when A
  /// is not positive definite, std::runtime_error when memory runs out. `mesh` outlives it.
  KeptFactor(const geometry::TetraMesh& mesh, const MaterialMap& material, const FixedComponents& fixed,
             const std::vector<double>& mass, const SystemWeights& weights, int most_compliance_nodes = 24,
             const AddedStiffness& added = {});

  /// Takes tetrahedra off K and off the factor. Precondition: each is there. False: what is left is not
  /// positive definite to working precision; to be answered with restore() or a new factor.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  /// Puts more mass on nodes, kg each, positive; on the factor too. Precondition: nodes differ. False as
  /// remove().
  [[nodiscard]] bool add_mass(std::span<const geometry::NodeId> nodes, double mass) noexcept;
  /// Each of them its own.
  [[nodiscard]] bool add_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept;
  /// Takes mass off nodes that differ, kg[i] off nodes[i], less than each has. False as remove().
  [[nodiscard]] bool take_mass(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept;
  /// As constructed.
  void restore() noexcept;

  /// x = A^-1 b, wrong by what float keeps of it.
  void solve_roughly(std::span<const double> b, std::span<double> x) noexcept;
  /// x = A^-1 b: roughly, then once more for what b lacks, in double.
  void solve(std::span<const double> b, std::span<double> x) noexcept;
  /// f = K u with the tetrahedra that are left, held components included, N.
  void holding_forces(std::span<const double> u, std::span<double> f) const noexcept;
  /// y = A x over the free components; `x` is zero in held ones.
  void multiply(std::span<const double> x, std::span<double> y) const noexcept;

  /// The rows and columns of A^-1 that belong to `nodes`, [3n x 3n], symmetric. Only the ways from them to
  /// the root of the elimination tree are visited. Precondition: at most `most_compliance_nodes`.
  void inverse_block(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept;
  /// E^T A^-1 E, [w x w], of columns E that are zero but at `nodes`: `rows` [3 nodes][w] of them. Visits the
  /// ways from all nodes. Precondition: w is at most 3 `most_compliance_nodes`.
  void project_inverse(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                       std::span<float> block) noexcept;

  /// What A is made of, and entries of its factor.
  const SystemWeights& weights() const { return weights_; }
  std::size_t entry_count() const { return panels_.entry_count(); }
  /// Nodes.
  std::int32_t node_count() const { return static_cast<std::int32_t>(mass_.size()); }
  /// Whether a support holds component `c` of the [3N].
  bool is_held(std::size_t c) const { return position_[c] < 0; }

 private:
  struct Assembled;
  KeptFactor(const geometry::TetraMesh& mesh, const MaterialMap& material, const std::vector<double>& mass,
             const SystemWeights& weights, int most_compliance_nodes, const Assembled& assembled);
  void subtract_element(geometry::TetId t) noexcept;
  RankSix root_of(geometry::TetId t) const noexcept;
  RankSix root_of_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg,
                         bool is_added) const noexcept;
  bool change_masses(std::span<const geometry::NodeId> nodes, std::span<const double> kg,
                     bool is_added) noexcept;
  bool apply(std::span<const RankSix> roots) noexcept;
  void touch(std::span<const geometry::NodeId> nodes) noexcept;

  const geometry::TetraMesh& mesh_;
  MaterialMap material_;
  std::vector<double> mass_, uncut_mass_;  // [N]
  SystemWeights weights_;
  using Blocks = std::vector<Eigen::Matrix3d, HugePages<Eigen::Matrix3d>>;
  std::vector<std::int32_t> start_, neighbour_;  // rows of K (Stiffness)
  Blocks block_, uncut_block_;                   // [B] of what is left, and of all
  std::vector<std::int32_t> component_;          // [n] which of 3N stands at each position
  std::vector<std::int32_t> position_;           // [3N]; -1: held
  FactorPanels panels_, uncut_;
  FactorDowndate downdate_;
  std::vector<std::uint8_t> changed_;  // [S] supernodes that differ from the uncut ones
  struct alignas(64) Row {
    float value[kernels::kTileRows];
  };
  std::vector<Row> scratch_;
  std::vector<float> x_;                       // [n]
  std::vector<double> residual_, correction_;  // [3N]
  InverseColumns columns_;
  std::vector<std::int32_t> touched_;  // positions, capacity 3N
  KnownBlocks known_blocks_;           // of what is left
};

}  // namespace omentum::physics
