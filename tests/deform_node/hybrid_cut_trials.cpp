#include "tests/deform_node/hybrid_cut_trials.h"

#include "deform_node/dynamic_maker.h"

namespace omentum::deform {

std::string try_hybrid_cuts(const test::HybridOrgan& organ, const std::string& law, std::uint32_t seed,
                            int ticks) {
  scene::OrganSpec spec = organ.spec;
  spec.dynamics->law = law;
  const organ::OrganSplit& split = *organ.source.organ.split;
  const std::vector<std::uint8_t> precomputed = split.precomputed();
  // blades a few centimetres long, through nodes of the dynamic part: those of the border cross it
  const TriedOrgan tried{.mesh = organ.source.organ.mesh,
                         .fixed = organ.source.organ.fixed,
                         .make = [&] { return make_hybrid(organ.source, spec); },
                         .places = split.parts.dynamic.node,
                         .depth_m = 0.03,
                         .precomputed = precomputed,
                         .turns = law == "corotational"};
  return try_cuts(tried, seed, ticks);
}

}  // namespace omentum::deform
