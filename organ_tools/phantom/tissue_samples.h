// Two pieces of tissue to cut and to tear, of the papers' sizes.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

namespace omentum::phantom {

/// A plate of 20 x 20 x 1 cm around the origin, its faces across z, its edges rounded (Cotin 1998, fig. 2).
double plate_distance(const Vec3& p);
ImplicitShape plate();

/// A cylinder of 16 cm along z from the origin downwards, 4 cm across, its edges rounded (Cotin 1998, fig.
/// 3).
double cylinder_distance(const Vec3& p);
ImplicitShape cylinder();

}  // namespace omentum::phantom
