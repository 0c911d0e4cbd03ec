#include "device_bridge/frames/base_frame.h"

namespace omentum::device {

Measurement to_scene(const BaseFrame& base, const Measurement& in_base) noexcept {
  Measurement in_scene = in_base;
  in_scene.position = base.p_WB + base.scale * (base.q_WB * in_base.position);
  in_scene.orientation = base.q_WB * in_base.orientation;
  in_scene.linear_velocity = base.scale * (base.q_WB * in_base.linear_velocity);
  in_scene.angular_velocity = base.q_WB * in_base.angular_velocity;
  return in_scene;
}

Wrench to_base(const BaseFrame& base, const Wrench& in_scene) noexcept {
  const Quat q_BW = base.q_WB.conjugate();
  return {base.scale * (q_BW * in_scene.force), q_BW * in_scene.torque, in_scene.grip_torque};
}

Measurement to_base(const BaseFrame& base, const Measurement& in_scene) noexcept {
  const Quat q_BW = base.q_WB.conjugate();
  Measurement in_base = in_scene;
  in_base.position = q_BW * Vec3(in_scene.position - base.p_WB) / base.scale;
  in_base.orientation = q_BW * in_scene.orientation;
  in_base.linear_velocity = q_BW * in_scene.linear_velocity / base.scale;
  in_base.angular_velocity = q_BW * in_scene.angular_velocity;
  return in_base;
}

}  // namespace omentum::device
