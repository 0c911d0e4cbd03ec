// The gauges of the models that deform_node has.
#pragma once

#include "deform_node/strain_gauge.h"
#include "physics/membrane_strain.h"
#include "physics/nodal_stress.h"

namespace omentum::deform {

/// Of a body all of whose nodes are known.
class BodyGauge final : public StrainGauge {
 public:
  /// `mesh` must outlive this.
  BodyGauge(const geometry::TetraMesh& mesh, const physics::MaterialMap& material, physics::StressLaw law)
      : nodal_(mesh, material, law) {}
  bool knows_stress() const noexcept override { return nodal_.knows_stress(); }
  void measure(const StrainedShape& shape, std::span<float> strain,
               std::span<float> stress_pa) noexcept override {
    nodal_.measure(
        {shape.body_u, shape.state.removed_bits, std::span(shape.surface).first(shape.node_count())}, strain,
        stress_pa);
  }

 private:
  physics::NodalStress nodal_;
};

/// Of an organ of which a surface is known, and nothing else.
class MembraneGauge final : public StrainGauge {
 public:
  /// Both must outlive this.
  MembraneGauge(const geometry::Surface& surface, const std::vector<Vec3>& rest) : strain_(surface, rest) {}
  bool knows_stress() const noexcept override { return false; }
  void measure(const StrainedShape& shape, std::span<float> strain,
               std::span<float> /*stress_pa*/) noexcept override {
    strain_.measure(std::span(shape.state.values).first(shape.state.value_count), strain);
  }

 private:
  physics::MembraneStrain strain_;
};

}  // namespace omentum::deform
