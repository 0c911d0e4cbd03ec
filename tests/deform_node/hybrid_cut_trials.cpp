#include "tests/deform_node/hybrid_cut_trials.h"

#include "deform_node/model_table.h"
#include "tests/deform_node/rates.h"

namespace omentum::deform {

std::string try_hybrid_cuts(const test::HybridOrgan& organ, const HybridTrial& trial, std::uint32_t seed,
                            int ticks) {
  scene::OrganSpec spec = organ.spec;
  spec.dynamics->law = trial.law;
  spec.dynamics->pieces = trial.pieces;
  const organ::OrganSplit& split = *organ.source.organ.split;
  const bool anywhere = trial.model == "hybrid-cut";
  const std::vector<std::uint8_t> precomputed = anywhere ? std::vector<std::uint8_t>{} : split.precomputed();
  // blades a few centimetres long, through nodes of the dynamic part: those of the border cross it
  TriedOrgan tried{.mesh = organ.source.organ.mesh,
                   .fixed = organ.source.organ.fixed,
                   .make = [&] { return find_model(model_table(), trial.model).make(organ.source, spec); },
                   .places = split.parts.dynamic.node,
                   .depth_m = 0.03,
                   .precomputed = precomputed,
                   .turns = trial.law == "corotational",
                   .most_way_m = trial.speed_m_s * kTick_s};
  if (anywhere)
    for (std::size_t n = 0; n < tried.mesh.positions.size(); ++n)
      if (!split.parts.dynamic.own_node[n].valid()) tried.places.emplace_back(n);
  return try_cuts(tried, seed, ticks);
}

}  // namespace omentum::deform
