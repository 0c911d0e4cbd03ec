// Where tissue comes to rest, whatever its law.
#pragma once

#include "physics/dynamics/force_law.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace omentum::tissue_compare {

/// Moves the components of `u` [3N], m, that are not `held` [3N] until no force is left on them: Newton's
/// method with conjugate gradients, the products by differences of forces over `step` m, which has to be
/// small against the edges. Throws std::runtime_error where it does not get there: the law has no minimum
/// near `u`.
void relax(physics::ForceLaw& law, const std::vector<std::uint8_t>& held, double step, Eigen::VectorXd& u);

}  // namespace omentum::tissue_compare
