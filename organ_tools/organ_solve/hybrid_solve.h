// A hybrid organ at rest: its dynamic part moves there, its precomputed part answers.
#pragma once

#include "organ_tools/organ_solve/cut_organ.h"
#include "organ_tools/organ_solve/solve_models.h"
#include "physics/hybrid/hybrid_step.h"

#include <filesystem>

namespace omentum::organ_tools {

/// By which law the dynamic part is deformed; the precomputed one is linear.
using physics::DynamicLaw;

/// Where a hybrid organ comes to rest under gravity with the imposed nodes held (Cotin 1998, fig. 5): the
/// dynamic part moves as move_to_rest() has its law move, with the stored tensors of the precomputed part
/// condensed onto the connection nodes, where imposed nodes of that part are held too; then the precomputed
/// part follows, its inner nodes elastically. Answers as solve_directly(). Throws geometry::InputError for an
/// organ without a dynamic part, for an imposed node inside the precomputed part, which has no tensors, and
/// where it finds no rest. Precondition: nothing was taken out of the precomputed part (hybrid_cut_solve.h).
physics::StaticSolution solve_hybrid(const organ::Organ& organ, const std::filesystem::path& file,
                                     const CutOrgan& cut, Imposed imposed, const geometry::Vec3& gravity,
                                     Numbering numbering, DynamicLaw law);

/// Throws geometry::InputError for an organ whose parts share no nodes and a model that knows nothing of what
/// ties them.
void require_knows_tie(const organ::Organ& organ, const std::filesystem::path& file,
                       const std::string& model);

}  // namespace omentum::organ_tools
