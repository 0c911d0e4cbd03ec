// The phantom's colon: a frame behind the small bowel, in the liver's frame.
#pragma once

#include "organ_tools/phantom/implicit_shape.h"

#include <vector>

namespace omentum::phantom {

/// The middle of its lumen: caecum low on the right, up below the liver, across, down on the left, and the
/// sigmoid's bend to the middle. All of it lies on one level against the back, where a small bowel in front
/// hides it. m; from the caecum on, at most 1 cm apart.
const std::vector<Vec3>& colon_axis();

/// A tube of some 5 cm around colon_axis(), wider at the caecum, with the pouches that three bands of muscle
/// gather.
double colon_distance(const Vec3& p);

ImplicitShape colon();

}  // namespace omentum::phantom
