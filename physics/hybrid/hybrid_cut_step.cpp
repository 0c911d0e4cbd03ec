#include "physics/hybrid/hybrid_cut_step.h"

#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/warped_step.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace omentum::physics {

namespace {

using geometry::NodeId;
using geometry::TetId;

std::unique_ptr<JoinableStep> step_of(const HybridTissue& tissue, double step_s, int most_compliance_nodes) {
  Inertia inertia = tissue.inertia;
  inertia.mass = masses_of_dynamic(tissue.mesh, std::move(inertia.mass), tissue.precomputed);
  if (tissue.law == DynamicLaw::kLinear) {
    return std::make_unique<ImplicitStep>(
        tissue.mesh, tissue.material, inertia,
        ImplicitOptions{.step_s = step_s, .most_compliance_nodes = most_compliance_nodes});
  }
  return std::make_unique<WarpedStep>(
      tissue.mesh, tissue.material, inertia, Corotational(tissue.mesh, tissue.material),
      WarpedOptions{
          .step_s = step_s, .most_compliance_nodes = most_compliance_nodes, .linear = tissue.precomputed});
}

std::vector<double> quarters_of(const HybridTissue& tissue) {
  const auto& x = tissue.mesh.positions;
  std::vector<double> kg;
  for (std::size_t t = 0; t < tissue.mesh.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = tissue.mesh.tetrahedra[t];
    kg.push_back(tissue.material.of(tissue.mesh, TetId(t)).density_kg_m3 *
                 geometry::signed_volume(x[a], x[b], x[c], x[d]) / 4);
  }
  return kg;
}

}  // namespace

std::vector<double> masses_of_dynamic(const geometry::TetraMesh& mesh, std::vector<double> mass,
                                      std::span<const std::uint8_t> precomputed) {
  std::vector<bool> is_dynamic(mass.size());
  for (std::size_t t = 0; t < precomputed.size(); ++t)
    if (precomputed[t] == 0)
      for (const NodeId n : mesh.tetrahedra[t]) is_dynamic[n] = true;
  for (std::size_t n = 0; n < mass.size(); ++n)
    if (!is_dynamic[n]) mass[n] = 0;
  return mass;
}

HybridCutStep::HybridCutStep(const HybridTissue& tissue, double step_s, int most_compliance_nodes)
    : mesh_(tissue.mesh),
      quarter_kg_(quarters_of(tissue)),
      step_(step_of(tissue, step_s, most_compliance_nodes)),
      parting_(tissue.mesh),
      anchor_kg_(anchor_stiffness(tissue.mesh, tissue.material) * step_->factor().weights().stiffness /
                 step_->factor().weights().mass),
      is_listed_(tissue.inertia.mass.size()) {
  massless_.reserve(is_listed_.size());
  kg_.reserve(is_listed_.size());
}

bool HybridCutStep::remove(std::span<const TetId> tetrahedra) noexcept {
  PartedTetrahedra parted = parting_.part(tetrahedra);
  massless_.clear();
  std::ranges::copy_if(parted.loose, std::back_inserter(massless_), [&](NodeId n) { return mass()[n] == 0; });
  parted.loose = massless_;
  const bool was_sound = std::exchange(is_sound_, true);
  return step_->part(parted, anchor_kg_) && was_sound;
}

void HybridCutStep::restore() noexcept {
  step_->restore();
  parting_.restore();
  is_sound_ = true;
}

// Also the mass of what goes next: that removal takes it off again.
void HybridCutStep::let_go(std::span<const TetId> tetrahedra) noexcept {
  massless_.clear();
  kg_.clear();
  for (const TetId t : tetrahedra) {
    for (const NodeId n : mesh_.tetrahedra[t]) {
      if (mass()[n] > 0 || is_listed_[n]) continue;
      massless_.push_back(n);
      is_listed_[n] = true;
      kg_.push_back(parting_.sum_around(n, quarter_kg_));
    }
  }
  for (const NodeId n : massless_) is_listed_[n] = false;
  is_sound_ = step_->give_masses(tetrahedra, massless_, kg_) && is_sound_;
}

}  // namespace omentum::physics
