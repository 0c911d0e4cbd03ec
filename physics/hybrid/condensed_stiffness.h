// The precomputed part of a hybrid organ, condensed onto the nodes that hold it or are held by it.
#pragma once

#include "physics/compliance_tiles.h"
#include "physics/surface_compliance.h"

#include <Eigen/Dense>

#include <span>

namespace omentum::physics {

/// C_AA of surface nodes A, [3n x 3n], m/N, in double whatever the tensors are stored in; x y z of each node.
template <class Scalar>
Eigen::MatrixXd compliance_among(const ComplianceTiles<const Scalar>& tiles,
                                 std::span<const SurfaceId> nodes);

/// S = C_AA^-1, N/m: what the part answers to displacements of A, f_A = S u_A, and nothing else
/// (Cotin 1998, fig. 5). Components that a support holds have no compliance, and get a stiffness of 1 of
/// their own that ties them to nothing. Throws geometry::InputError where C_AA is not positive definite: the
/// tensors are damaged.
Eigen::MatrixXd condensed_stiffness(Eigen::MatrixXd C_AA);

}  // namespace omentum::physics
