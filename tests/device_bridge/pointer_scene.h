// A viewer of the mouse's tests: looks along +y from (0, -0.5, 0), z is up in the picture.
#pragma once

#include "device_bridge/device.h"

namespace omentum::test {

/// The ray to `place`, numbered and stamped by nobody; the viewer may stand elsewhere.
inline msg::PointerRay ray_to(const Eigen::Vector3d& place,
                              const Eigen::Vector3d& eye = Eigen::Vector3d(0, -0.5, 0)) {
  msg::PointerRay ray;
  ray.valid = true;
  ray.origin = device::to_message(eye);
  ray.direction = device::to_message(Eigen::Vector3d((place - eye).normalized()));
  ray.right = {1, 0, 0};
  ray.up = {0, 0, 1};
  return ray;
}

}  // namespace omentum::test
