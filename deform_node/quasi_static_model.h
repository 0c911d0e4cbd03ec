// An organ that is always in equilibrium: precomputed force tensors, superposed.
#pragma once

#include "deform_node/organ_models.h"
#include "geometry/sphere_cover.h"
#include "geometry/surface.h"
#include "physics/surface_compliance.h"

#include <vector>

namespace omentum::deform {

/// Cotin 1999, section 4-2, in force form: u = C_:A f_A. Superposing the tools' *forces* is exact for any
/// number of tools, one of whose contacts may be a tick older than the other's (docs/decisions.md 4). It
/// cannot be cut, offers no local model, since haptic_node has the whole one, and no other organ moves it:
/// its spheres push, as the surface above them moves, and do not yield.
class QuasiStaticModel final : public OrganModel {
 public:
  /// All must outlive the model; the tensors are the surface's, and so is `rest`, [S], m.
  QuasiStaticModel(const physics::SurfaceCompliance& compliance, const geometry::Surface& surface,
                   const std::vector<Vec3>& rest, geometry::SphereCover cover = {});

  ModelSizes sizes() const override {
    return {.values = displacements_.size(), .spheres = cover_.spheres.size()};
  }
  void step(const TickLoads& loads, double dt_s) noexcept override;
  void reset() noexcept override;
  OrganView view() const noexcept override {
    return {.kind = StateKind::kSurface, .topology_version = 0, .values = displacements_};
  }
  ModelStatus status() const noexcept override { return {.steps = steps_}; }
  std::unique_ptr<StrainGauge> strain_gauge() const override;
  std::span<const CollisionSphere> collidable() const noexcept override;

 private:
  Vec3 displacement_above(const geometry::CoverSphere& sphere) const noexcept;

  const physics::SurfaceCompliance& compliance_;
  const geometry::Surface& surface_;
  const std::vector<Vec3>& rest_;
  std::vector<SurfaceId> nodes_;      // workspace: A, of all tools
  std::vector<Vec3> forces_;          // workspace: f_A
  std::vector<float> tiled_;          // [cluster][3][16], as superpose_surface writes it
  std::vector<float> displacements_;  // [3 S]
  geometry::SphereCover cover_;
  double dt_s_ = 0;                               // of the last step; 0: none since a reset
  mutable std::uint64_t shown_at_ = 0;            // steps_ at the last collidable()
  mutable std::vector<CollisionSphere> spheres_;  // [cover_]
  std::uint64_t steps_ = 0;
};

}  // namespace omentum::deform
