// Where a device's base stands in the scene, and how much farther the tool goes than the hand.
#pragma once

#include "device_bridge/device.h"

namespace omentum::device {

/// B is the device's base, W the scene's frame. The tool goes `scale` times as far as the hand, and turns as
/// it turns:
///
///     p_W = p_WB + s R_WB p_B,   v_W = s R_WB v_B,   w_W = R_WB w_B,   q_WT = q_WB q_BT
struct BaseFrame {
  Quat q_WB = Quat::Identity();
  Vec3 p_WB = Vec3::Zero();  // m
  double scale = 1;          // m of the tool per m of the hand, above 0
};

/// A measurement in B as one in W.
Measurement to_scene(const BaseFrame& base, const Measurement& in_base) noexcept;

/// A wrench on the tool in W as the one on the hand in B that does the same work: by the principle of virtual
/// work f_B = s R_BW f_W and t_B = R_BW t_W, since f_W . s R_WB v_B = f_B . v_B.
Wrench to_base(const BaseFrame& base, const Wrench& in_scene) noexcept;

/// The inverse of to_scene().
Measurement to_base(const BaseFrame& base, const Measurement& in_scene) noexcept;

}  // namespace omentum::device
