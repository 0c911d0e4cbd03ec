#include "deform_node/hybrid_gauge.h"

#include <algorithm>

namespace omentum::deform {

HybridGauge::HybridGauge(const organ::Organ& organ, std::span<const double> weights, physics::StressLaw law)
    : inner_(organ.split->parts.precomputed, organ.split->surface, organ.split->fixed, organ.material,
             weights),
      nodal_(organ.mesh, organ.material, law),
      u_(3 * organ.mesh.positions.size()) {}

void HybridGauge::measure(const StrainedShape& shape, std::span<float> strain,
                          std::span<float> stress_pa) noexcept {
  std::ranges::copy(shape.body_u, u_.begin());
  inner_.follow(u_);
  nodal_.measure({u_, shape.state.removed_bits, std::span(shape.surface).first(shape.node_count())}, strain,
                 stress_pa);
}

}  // namespace omentum::deform
