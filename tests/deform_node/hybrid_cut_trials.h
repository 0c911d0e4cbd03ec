// Random cuts of hybrid organs through their border and inside their dynamic part, under a hand that pulls.
#pragma once

#include "tests/deform_node/cut_trials.h"
#include "tests/deform_node/hybrid_organ.h"

namespace omentum::deform {

/// A sequence of cut_trials.h in which the organ's dynamic part follows `law` (scene/dynamics_spec.h), and
/// nothing goes of the precomputed one.
std::string try_hybrid_cuts(const test::HybridOrgan& organ, const std::string& law, std::uint32_t seed,
                            int ticks);

}  // namespace omentum::deform
