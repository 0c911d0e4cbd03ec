// The precomputed organ, cut: its factor follows the removals, as deform_node's does.
#pragma once

#include "organ_tools/organ_solve/cut_organ.h"
#include "organ_tools/organ_solve/solve_models.h"

namespace omentum::organ_tools {

/// Factorizes the stiffness of the whole organ, takes the removed tetrahedra off the factor one after the
/// other (physics::StaticFactor), and answers imposed displacements by the corrected compliance of their
/// nodes: f_A = C_AA^-1 (u* - u_g), u = u_g + C_:A f_A (Cotin 1999, section 4-2, in force form). Answers as
/// solve_directly(); a solve in each imposed component. Throws geometry::InputError where what is left hangs
/// together too loosely, physics::FloatingError where supports alone do not hold the uncut organ.
physics::StaticSolution solve_cut(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                  const geometry::Vec3& gravity);

}  // namespace omentum::organ_tools
