// The phantom's gallbladder: a second organ beside the liver, in the same frame.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

namespace omentum::phantom {

/// A pear of about 8 x 3.5 cm: its neck deep under the liver, its body below the fossa (liver_shape.h), its
/// fundus in front of the inferior edge, where an instrument reaches it. It lies free of the liver at rest,
/// with a gap of some 3 mm: organs do not push each other yet.
double gallbladder_distance(const Vec3& p);

ImplicitShape gallbladder();

}  // namespace omentum::phantom
