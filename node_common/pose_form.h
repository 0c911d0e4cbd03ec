// Whether a pose is one, by itself.
#pragma once

#include "transport/messages.h"

#include <cstdint>

namespace omentum::node {

enum class PoseForm : std::uint8_t {
  kInvalid,       // the device says that it has no measurement
  kNotFinite,     // NaN or infinity in any number
  kNotARotation,  // the quaternion's length is off
  kWell,
};

/// The first of these that holds, in their order. A quaternion's length may be off by 1e-3.
PoseForm form_of(const msg::ToolPose& pose) noexcept;

}  // namespace omentum::node
