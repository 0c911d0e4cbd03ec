// The room in which the phantom's organs lie: inside of the abdominal wall, and what covers its bottom.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

namespace omentum::phantom {

/// The inside of an abdomen that gas holds open, from the diaphragm's dome (towards +y) to the pelvis:
/// negative where the room is. Ribs and the costal arch stand out into it.
ImplicitShape cavity();
/// Distance to it, m.
double cavity_distance(const Vec3& p);

/// The greater omentum, spread over bowel that is not there: uneven, below the liver, from wall to wall.
ImplicitShape omentum();
/// Distance to it, m.
double omentum_distance(const Vec3& p);

}  // namespace omentum::phantom
