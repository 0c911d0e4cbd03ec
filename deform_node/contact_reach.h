// How far a contact's forces would move the tissue.
#pragma once

#include "physics/surface_compliance.h"

namespace omentum::deform {

using geometry::SurfaceId;
using geometry::Vec3;

/// The largest displacement among the nodes that the forces act on: C_AA f_A, m. Compliance falls off with
/// distance, so that nothing else moves much farther. `nodes` and `forces` (N) have equal length; nodes are
/// mobile. Allocates nothing.
double largest_displacement_m(const physics::SurfaceCompliance& compliance, std::span<const SurfaceId> nodes,
                              std::span<const Vec3> forces) noexcept;

/// No contact moves a precomputed organ farther than this, m: the diagonal of the box around it at rest.
/// Linear elasticity is trusted to a tenth of its size.
double reach_of(std::span<const Vec3> rest) noexcept;

}  // namespace omentum::deform
