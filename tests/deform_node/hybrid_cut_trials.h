// Random cuts of hybrid organs through their border and inside their parts, under a hand that pulls.
#pragma once

#include "tests/deform_node/cut_trials.h"
#include "tests/deform_node/hybrid_organ.h"

namespace omentum::deform {

/// Which hybrid organ, and how it is treated.
struct HybridTrial {
  std::string model =
      "hybrid";  // or "hybrid-cut", which is cut anywhere; of the other nothing precomputed goes
  std::string law = "linear";   // of the dynamic part (scene/dynamics_spec.h)
  std::string pieces = "fall";  // "hybrid-cut": what becomes of them
  double speed_m_s = 0.2;       // of the hand
};

/// A sequence of cut_trials.h.
std::string try_hybrid_cuts(const test::HybridOrgan& organ, const HybridTrial& trial, std::uint32_t seed,
                            int ticks);

}  // namespace omentum::deform
