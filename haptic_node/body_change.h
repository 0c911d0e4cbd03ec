// A body that comes, or goes, while the loop runs.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// What came through the doors since the last tick is there from now on. Tools that touch what stood there
/// touch what came, with the same force, at the material point that is the same without forces; where there
/// is none within Body::kReach_m they let go. A tool inside of what comes to an empty place has appeared
/// there (lost_contact.h). No allocation.
void take_in_bodies(HapticState& state, HapticWorkspace& work) noexcept;

}  // namespace omentum::haptic
