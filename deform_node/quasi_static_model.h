// An organ that is always in equilibrium: precomputed force tensors, superposed.
#pragma once

#include "deform_node/organ_models.h"
#include "physics/surface_compliance.h"

#include <vector>

namespace omentum::deform {

/// Cotin 1999, section 4-2, in force form: u = C_:A f_A. Superposing the tools' *forces* is exact for any
/// number of tools, one of whose contacts may be a tick older than the other's (docs/decisions.md 4).
class QuasiStaticModel final : public OrganModel {
 public:
  /// `compliance` must outlive the model. `surface_nodes`: pinned ones included.
  QuasiStaticModel(const physics::SurfaceCompliance& compliance, std::int32_t surface_nodes);

  void step(std::span<const ToolLoad> loads, double dt_s) noexcept override;
  void reset() noexcept override;
  std::span<const float> displacements() const noexcept override { return displacements_; }

 private:
  const physics::SurfaceCompliance& compliance_;
  std::vector<SurfaceId> nodes_;      // workspace: A, of all tools
  std::vector<Vec3> forces_;          // workspace: f_A
  std::vector<float> tiled_;          // [cluster][3][16], as superpose_surface writes it
  std::vector<float> displacements_;  // [3 S]
};

}  // namespace omentum::deform
