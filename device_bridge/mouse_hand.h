// A hand that a person moves with a mouse: it yields to the force that it feels, since the mouse cannot.
#pragma once

#include "device_bridge/jaw_hand.h"
#include "device_bridge/pointer_aim.h"
#include "device_bridge/ray_inbox.h"
#include "device_bridge/virtual_hand.h"

namespace omentum::device {

/// How hard a mouse pulls an instrument at most, N: the hand's spring is then kMousePull_n / its stiffness
/// long, 25 mm, and whatever is wanted beyond is forgotten. So the tip stands still where tissue holds that
/// force, and the way back is not longer than the way there seemed.
inline constexpr double kMousePull_n = 10;
/// The tip stays this far inside of its trocar, m: nearer, a shaft turns faster than any hand turns it.
inline constexpr double kLeastInsertion_m = 0.03;
/// rad/s; a brisk wrist.
inline constexpr double kMouseTurn_rad_s = 2;

/// From the pointer's rays to poses: PointerAim says where the tip is wanted, glide() makes a way of it, and
/// the tip hangs on its end by a spring and a damper (hand_model.h), which a force of tissue extends:
///
///     m x'' = k (target - x) + d (target' - x') + f,   |target - x| <= kMousePull_n / k
///
/// A passive element between mouse and tissue, whatever the rays do. Until a valid ray comes for its tool the
/// scene's script plays it, or it waits at the script's start (`waits`); from then on it is the mouse's, and
/// rests where it was left while the mouse drives another tool, with its jaws as they were. Silent rays:
/// the tip rests, the jaws stay, what cuts stops.
///
/// The right button and the space bar close jaws, the left button and X cut; where a tool does not cut the
/// left button closes its jaws too. Jaws that somebody left closed open when the button is pressed anew and
/// let go.
class MouseHand : public Device {
 public:
  /// `rays` must outlive this. Its own hand is as heavy and stiff as a relaxed one, whatever the scene's.
  MouseHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz, const RayInbox& rays,
            bool waits);

  msg::DeviceInfo info() const override;
  void command(const Wrench& wrench) noexcept override;
  Measurement measure(std::int64_t now_ns) noexcept override;
  bool simulates() const noexcept override { return true; }

  /// The mouse moves nothing while the session is paused.
  void pause(bool paused) noexcept override;
  /// The tip glides back to where its script starts.
  void restart() noexcept override;
  /// {"tool", "peak_force_n", "peak_grip_torque_nm", "rays"}: how many were followed, and what was felt then.
  nlohmann::json report() const override;

 private:
  void hear(std::int64_t now_ns) noexcept;
  void take_over() noexcept;
  void advance(double dt_s) noexcept;
  void hold_back() noexcept;
  Vec3 within_reach(const Vec3& place) const noexcept;
  Quat turn(double dt_s) noexcept;
  void use(std::int64_t now_ns, double dt_s) noexcept;

  scene::HandSpec hand_;  // the mouse's
  scene::ToolSpec tool_;
  double period_s_;
  const RayInbox& rays_;
  VirtualHand script_;
  bool driven_;
  Measurement now_;
  Vec3 start_;       // of the tip
  Quat start_turn_;  // of the shaft
  Vec3 inward_;      // from the trocar, unit
  PointerAim aim_;
  Motion target_, tip_;
  Quat wanted_turn_ = Quat::Identity(), turn_ = Quat::Identity();  // of the shaft, where there is no trocar
  double roll_ = 0;
  bool jaws_left_ = true;  // as they were when the mouse came
  Wrench wrench_;
  bool paused_ = false;
  std::int64_t heard_ns_ = 0;  // when the newest ray came
  std::uint64_t followed_ = 0;
  double peak_force_n_ = 0, peak_grip_torque_nm_ = 0;
};

}  // namespace omentum::device
