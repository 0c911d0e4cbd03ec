// Strain and stress of a hybrid organ, both of whose parts are of one tissue.
#pragma once

#include "deform_node/strain_gauge.h"
#include "organ/organ.h"
#include "physics/hybrid/inner_nodes.h"
#include "physics/nodal_stress.h"

namespace omentum::deform {

/// Measured as a body is, once the nodes inside the precomputed part are where its surface takes them.
class HybridGauge final : public StrainGauge {
 public:
  /// `organ`, which has a split, outlives this; `weights`: [3N], N, that always act; `law`: the dynamic
  /// part's. The precomputed part turns too little to tell one from the other.
  HybridGauge(const organ::Organ& organ, std::span<const double> weights, physics::StressLaw law);

  bool knows_stress() const noexcept override { return nodal_.knows_stress(); }
  void measure(const StrainedShape& shape, std::span<float> strain,
               std::span<float> stress_pa) noexcept override;

 private:
  physics::InnerNodes inner_;
  physics::NodalStress nodal_;
  std::vector<double> u_;  // [3N]
};

}  // namespace omentum::deform
