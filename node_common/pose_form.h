// Whether a pose is one, by itself.
#pragma once

#include "transport/messages.h"

#include <cstdint>

namespace omentum::node {

enum class PoseForm : std::uint8_t {
  kWell,
  kInvalid,       // the device says that it has no measurement
  kNotFinite,     // NaN or infinity in any number
  kNotARotation,  // the quaternion's length is off
};

PoseForm form_of(const msg::ToolPose& pose) noexcept;

}  // namespace omentum::node
