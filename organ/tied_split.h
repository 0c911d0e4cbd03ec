// How the parts of a hybrid organ that share no nodes are tied, found again from the faces that touch.
#pragma once

#include "organ/split_organ.h"

namespace omentum::organ {

/// Sets `border`, `tie`, `covered` and `connection` of a split whose parts and surface are there. Throws
/// geometry::InputError, beginning with `where`: for faces of neither part, for a border of one part alone,
/// for parts that share nodes, and for a dynamic part that is finer at the border than the precomputed one,
/// which would leave nodes of it that nothing holds.
void tie_split(OrganSplit& split, BorderFaces border, const std::string& where);

}  // namespace omentum::organ
