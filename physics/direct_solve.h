// A static solve without any precomputation: the reference that the tensors must equal.
#pragma once

#include "physics/static_solution.h"
#include "physics/stiffness_factor.h"

namespace omentum::physics {

/// K u = f + r with u = u* at the imposed nodes A and 0 at the supports, by exact elimination:
/// K_ff u_f = f_f - K_fA u*, and r_A = K_A: u - f_A holds the imposed nodes. `loads`: [N], N, or empty for
/// none. Preconditions: no node is imposed twice; imposed displacements are zero in held components. Throws
/// FloatingError when supports and imposed nodes together leave the organ floating.
StaticSolution direct_solve(const Stiffness& stiffness, const FixedComponents& fixed,
                            std::span<const ImposedDisplacement> imposed, std::span<const Vec3> loads);

}  // namespace omentum::physics
