// The strain of an intestine and its mesentery, by the places of their masses.
#pragma once

#include "deform_node/strain_gauge.h"
#include "geometry/gut_shape.h"
#include "physics/membrane_strain.h"

namespace omentum::deform {

/// At each mass that of the mesentery along itself (physics/membrane_strain.h); at a mass of the axis the
/// gut's own elongation, l / l0 - 1 over the segments to both sides, where that is larger. What bends the gut
/// without stretching it is not in it. No stress: springs have none that is theirs.
class GutGauge final : public StrainGauge {
 public:
  /// `rest` must outlive this. Triangles without area there, where the mesentery ends, do not count.
  explicit GutGauge(const geometry::GutShape& rest);
  bool knows_stress() const noexcept override { return false; }
  void measure(const StrainedShape& shape, std::span<float> strain,
               std::span<float> stress_pa) noexcept override;

 private:
  const geometry::GutShape& rest_;
  geometry::Surface mesentery_;  // numbered as masses are
  physics::MembraneStrain membrane_;
  std::vector<float> u_;  // workspace: [3 masses], from rest, m
};

}  // namespace omentum::deform
