// How far single precision put a solution of the tensors off, without solving anew.
#pragma once

#include "organ/stored_tensors.h"
#include "organ_tools/organ_solve/solve_models.h"
#include "physics/stiffness.h"

namespace omentum::organ_tools {

/// Largest differences of single components from the exact answer.
struct TensorError {
  double force = 0;         // as a fraction of the largest component of a holding force
  double displacement = 0;  // as a fraction of the largest component of a displacement
};

/// By what the solution lacks of equilibrium: with r = (K u - f) on the free nodes F that are not imposed
/// (only those of the surface have any), the exact answer is u + C_:A g - C_:F r, with g = C_AA^-1 C_AF r,
/// held by (K u - f)_A + g. Evaluated with the same tensors, so that it is wrong by the square of their
/// error. `loads`: [N], N, or empty. Preconditions: tensors stored in float; `solution` is what they answer
/// to `imposed`.
TensorError measure_error(const organ::Organ& organ, const organ::StoredTensors& tensors,
                          const physics::Stiffness& stiffness, std::span<const geometry::Vec3> loads,
                          Imposed imposed, const physics::StaticSolution& solution);

}  // namespace omentum::organ_tools
