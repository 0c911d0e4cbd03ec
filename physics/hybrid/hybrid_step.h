// Backward Euler for a hybrid organ: one part has masses and is cut, the other one is precomputed.
#pragma once

#include "physics/dynamics/known_blocks.h"
#include "physics/hybrid/hybrid_body.h"
#include "physics/hybrid/precomputed_part.h"

#include <memory>

namespace omentum::physics {

/// The tissue of the precomputed part is that of the dynamic one without its mass: K (u + b v) = f at all of
/// its nodes but the connection nodes, whose masses are whole. Condensed onto these it is a stiffness S of
/// the dynamic part's equation and a force f_c (precomputed_part.h), both of the same step: a force that is
/// one step old would make it unstable. So the whole is one implicit step of all tissue, and stable for any
/// dt. With the co-rotational law the dynamic part may turn as far as it likes, the precomputed one not: S
/// takes a turn of the border for a strain, and holds against it.
///
/// Parts that share no nodes are two meshes in one, as `whole` is numbered. Their connection nodes are the
/// precomputed part's own and follow nodes of the dynamic one, w_c = P (u + b v), which take P^T S P, P^T f_c
/// and the lumped masses P^T m_c in return: still one implicit step, of less freedom. A leading node that
/// loses all its tetrahedra goes on to lead: the precomputed part's bared border keeps to the shapes that P
/// has.
///
/// Vectors are [3N] of the whole mesh. Nodes inside the precomputed part have no tensors: theirs stay as they
/// are, and forces on them beside `weights` do nothing. Only tetrahedra of the dynamic part are removed,
/// others passed over. All memory is taken at construction; one thread at a time.
class HybridStep final : public LargeStep {
 public:
  /// Throws as KeptFactor, StiffnessFactor and PrecomputedPart do.
  HybridStep(HybridBody body, double step_s, int most_compliance_nodes);

  double step_s() const override { return dynamic_->step_s(); }
  [[nodiscard]] bool step(BodyState& state, std::span<const double> external) noexcept override;
  [[nodiscard]] bool step_again(BodyState& state, std::span<const double> external) noexcept override;
  /// Of the dynamic part, and of the precomputed one as far as its connection nodes deform it: no more than
  /// what work() has done.
  double elastic_energy(std::span<const double> u) noexcept override;
  double work(std::span<const double> external, std::span<const double> v) noexcept override;

  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept override;
  void restore() noexcept override;
  /// Zero at the precomputed part's own nodes.
  std::span<const double> mass() const noexcept override { return mass_; }

  /// Of both parts together: a tool may lie on the border.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept override;
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override;
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override;

  const PrecomputedPart& precomputed() const { return part_; }

 private:
  using Sag = PrecomputedPart::Sag;

  PrecomputedPart::Loads loads() const { return {loaded_, loads_}; }
  using Step = decltype(&LargeStep::step);
  bool move(BodyState& state, std::span<const double> external, Step step) noexcept;
  void collect_loads(std::span<const double> forces, Sag sag) noexcept;
  void condense(std::span<const double> forces, Sag sag) noexcept;
  void gather(std::span<const double> whole, std::span<double> own) const noexcept;
  void scatter(std::span<const double> own, std::span<double> whole) const noexcept;
  void find_mass() noexcept;
  void lead(std::span<const double> u, std::span<const double> v) noexcept;
  void follow(Sag sag) noexcept;
  void find_rows(std::span<const geometry::NodeId> nodes) noexcept;
  void add_yield_held(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept;

  std::vector<geometry::NodeId> node_;            // [d] of the whole, each dynamic node
  std::vector<geometry::NodeId> own_node_;        // [N] of the dynamic part; invalid: none of it
  std::vector<geometry::TetId> own_tetrahedron_;  // [T] of the dynamic part
  Connection connection_;
  std::vector<geometry::NodeId> surface_node_;  // [mobile] of the whole, each of the precomputed surface
  std::vector<SurfaceId> surface_of_;           // [N] of the precomputed part's own; invalid: none
  std::vector<double> weights_;                 // [3N]
  double viscosity_s_;                          // b
  PrecomputedPart part_;
  std::unique_ptr<JoinableStep> dynamic_;
  std::vector<double> mass_;          // [N], kg
  BodyState own_;                     // of the dynamic part
  std::vector<double> own_external_;  // [3d], N
  std::vector<double> own_yield_;     // [3d], m
  std::vector<double> own_ahead_;     // [3d], m, where a step would end
  std::vector<double> f_c_, w_c_;     // [3c]
  std::vector<double> w_;             // [3 mobile], m
  std::vector<SurfaceId> loaded_;     // capacity mobile
  std::vector<Vec3> loads_;
  std::vector<geometry::TetId> removed_;  // workspace, capacity of the dynamic part
  // workspace of compliance(): p nodes, of them q of the precomputed part's own
  std::vector<SurfaceId> touched_;         // [q]
  std::vector<geometry::NodeId> support_;  // leaders of the connection, then other dynamic nodes
  Eigen::MatrixXd passed_on_, held_;       // [3c x 3q], [3q x 3q]
  std::vector<double> led_;                // [3m]
  std::vector<float> rows_;                // [3 support][3p]
  std::vector<geometry::NodeId> turned_;   // [p] of the dynamic part; invalid: none of it
  KnownBlocks known_;
};

}  // namespace omentum::physics
