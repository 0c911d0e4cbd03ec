// What the tools' contacts did in a tick, in joules.
#pragma once

#include "haptic_node/haptic_model.h"

#include <span>

namespace omentum::haptic {

/// `free_gaps`, `gaps`: [contacts] p - X without and with the tissue's displacement, m, after the solve whose
/// forces the contacts carry; `before`: [contacts] their forces of the last tick, N. `works`: [tools],
/// overwritten. No allocation.
void measure_work(const HapticModel& model, const HapticState& state, std::span<const Vec3> before,
                  std::span<const Vec3> free_gaps, std::span<const Vec3> gaps,
                  std::span<ContactWork> works) noexcept;

}  // namespace omentum::haptic
