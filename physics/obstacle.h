// What keeps an elastic body out of a rigid obstacle that may only push, in one direction.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace omentum::physics {

/// The forces p >= 0, [n], N, whose displacements clear the obstacle: A p >= g, and A p = g where p > 0 (a
/// linear complementarity problem). `compliance`: A, [n x n], m/N, symmetric and positive definite; `depth`:
/// g, [n], m, how far each place has to give way (negative: how far it may come). Block principal pivoting
/// (Judice and Pires 1994), which is finite by Murty's rule. Nothing where A is not positive definite, or so
/// badly conditioned that the exchange does not settle within 50 n rounds.
std::optional<Eigen::VectorXd> clear_obstacle(const Eigen::MatrixXd& compliance,
                                              const Eigen::VectorXd& depth);

}  // namespace omentum::physics
