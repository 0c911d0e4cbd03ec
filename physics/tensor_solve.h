// The exact answer of the precomputed tensors to imposed displacements (Cotin 1999, section 4-2).
#pragma once

#include "physics/compliance_tiles.h"
#include "physics/static_solution.h"
#include "physics/stiffness_factor.h"

namespace omentum::physics {

struct SurfaceSolution {
  std::vector<Vec3> displacements;   // [mobile], m
  std::vector<Vec3> holding_forces;  // one per imposed node, N
  double rcond = 1;                  // estimated reciprocal condition number of C_AA
};

/// A surface node and its imposed displacement, m.
struct ImposedSurfaceNode {
  geometry::SurfaceId node;
  Vec3 displacement;
};

/// f_A = C_AA^-1 u*, u = C_:A f_A, both in double whatever the tensors are stored in (the same as eqs. 7-9
/// with M u~ = u*, without their transposed indices). Held components of an imposed node get no force.
/// `Scalar` is float or double: its rounding enters the result up to 1 / rcond times (neighbours that are
/// moved each their own way). Throws InputError when the tensors are damaged: C_AA is not positive definite,
/// or a result is not finite. Preconditions: nodes are mobile and differ.
template <class Scalar>
SurfaceSolution tensor_solve(const ComplianceTiles<const Scalar>& tiles, const geometry::Surface& surface,
                             const FixedComponents& fixed, std::span<const ImposedSurfaceNode> imposed);

/// Displacements of all nodes, [N], from those of the surface: the inside follows elastically, K_II u_I = f_I
/// - K_IS u_S. `on_surface`: [N], read at surface nodes; `loads`: [N] or empty.
std::vector<Vec3> extend_inside(const Stiffness& stiffness, const FixedComponents& fixed,
                                const geometry::Surface& surface, std::span<const Vec3> on_surface,
                                std::span<const Vec3> loads);

}  // namespace omentum::physics
