// Vectors between messages and mathematics.
#pragma once

#include "transport/messages.h"

#include <Eigen/Core>

namespace omentum::node {

inline msg::Vec3 to_message(const Eigen::Vector3d& v) noexcept {
  return {.x = v.x(), .y = v.y(), .z = v.z()};
}

inline Eigen::Vector3d to_vector(const msg::Vec3& v) noexcept {
  return {v.x, v.y, v.z};
}

}  // namespace omentum::node
