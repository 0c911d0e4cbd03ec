// A hybrid organ at rest whose precomputed part was cut too.
#pragma once

#include "organ_tools/organ_solve/hybrid_solve.h"

namespace omentum::organ_tools {

/// Whether tetrahedra of the precomputed part were taken out: its stored tensors say nothing of what is left.
bool cuts_precomputed(const organ::Organ& organ, const CutOrgan& cut);

/// solve_hybrid() by the step of such an organ (physics/hybrid/hybrid_cut_step.h), whatever was taken out,
/// and for imposed nodes anywhere. Throws geometry::InputError where it finds no rest, and for another law
/// than the linear one.
physics::StaticSolution solve_hybrid_cut(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                         const geometry::Vec3& gravity, DynamicLaw law);

}  // namespace omentum::organ_tools
