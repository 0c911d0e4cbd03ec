// Backward Euler for a hybrid organ that is cut in either part.
#pragma once

#include "physics/dynamics/joinable_step.h"
#include "physics/hybrid/hybrid_step.h"
#include "physics/parting.h"

#include <memory>

namespace omentum::physics {

/// A whole organ, and which of its tetrahedra are precomputed. `mesh` and `material` outlive the step.
struct HybridTissue {
  const geometry::TetraMesh& mesh;
  const MaterialMap& material;
  Inertia inertia;                        // of all tissue, [N]
  std::vector<std::uint8_t> precomputed;  // [T] other than 0
  DynamicLaw law = DynamicLaw::kLinear;   // of the dynamic part
};

/// The step of HybridStep, with the precomputed part in the factor instead of in stored tensors: one implicit
/// step of all tissue in which the precomputed part's own nodes have no mass, K (u + b v) = f, and its
/// tetrahedra do not turn. So a removal is six ranks off one factor wherever it is, the stiffness of the
/// border follows by itself, and a node of the inside has a compliance when it comes to the surface. S
/// itself is never formed: removing an element would change it by six ranks too, each a solve of the
/// precomputed part, in a block that is dense.
///
/// Pieces of precomputed tissue that nothing holds would make the equation singular. Whoever removes finds
/// them before (UnheldPieces), and takes them along or makes them dynamic.
///
/// Vectors are [3N]. All memory is taken at construction; one thread at a time.
class HybridCutStep final : public LargeStep {
 public:
  /// Throws as KeptFactor does.
  HybridCutStep(const HybridTissue& tissue, double step_s, int most_compliance_nodes);

  double step_s() const override { return step_->step_s(); }
  [[nodiscard]] bool step(BodyState& state, std::span<const double> external) noexcept override {
    return step_->step(state, external);
  }
  [[nodiscard]] bool step_again(BodyState& state, std::span<const double> external) noexcept override {
    return step_->step_again(state, external);
  }
  double elastic_energy(std::span<const double> u) noexcept override { return step_->elastic_energy(u); }

  /// Precondition: each is there; with them gone, supports or masses hold all that is left.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept override;
  void restore() noexcept override;
  /// Zero at the precomputed part's own nodes.
  std::span<const double> mass() const noexcept override { return step_->mass(); }
  /// These are dynamic from now on, until restore(): their nodes get the masses of the tissue that is given,
  /// and they turn where the law does. To be called before the removal that leaves them loose.
  void let_go(std::span<const geometry::TetId> tetrahedra) noexcept override;

  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept override {
    step_->compliance(nodes, block);
  }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    step_->yield_to(forces, yield);
  }
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override {
    step_->foresee(state, external, u);
  }

  /// The factor, for who finds a rest by it.
  KeptFactor& factor() { return step_->factor(); }

 private:
  const geometry::TetraMesh& mesh_;
  std::vector<double> quarter_kg_;  // [T] of each tetrahedron's mass
  std::unique_ptr<JoinableStep> step_;
  Parting parting_;
  double anchor_kg_;
  std::vector<geometry::NodeId> massless_;  // workspace, capacity N
  std::vector<double> kg_;                  // likewise
  std::vector<bool> is_listed_;             // [N] in massless_
  bool is_sound_ = true;
};

/// The masses of a hybrid organ: none at nodes that precomputed tetrahedra alone are around, [N], kg.
std::vector<double> masses_of_dynamic(const geometry::TetraMesh& mesh, std::vector<double> mass,
                                      std::span<const std::uint8_t> precomputed);

}  // namespace omentum::physics
