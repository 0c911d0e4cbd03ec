// The last stage before the motors: no jump, and no energy from nowhere.
#pragma once

#include "device_bridge/device.h"
#include "node_common/energy_tank.h"

#include <cstdint>

namespace omentum::device {

/// Follows what the hand really received, which only the device knows: the forces that it exerted, held and
/// decayed ones too, along the way that it measured. What a lost answer, a failed write or a source in the
/// model would give besides is not exerted. Reads no clock. One thread.
///
/// What tissue holds is not known here: at most the force that is asked for times the way from where none
/// was. So after a pause in a press, letting go is felt as far as the reserve goes.
///
/// A force may fall as it likes. It rises and turns no faster than kFastest_n_s, and for that a stalled loop
/// counts for one of its own periods.
class HandGuard {
 public:
  /// The fastest rise, N/s and N m/s: what haptic_node's own slew limit is by default, 10 N and 0.5 N m in
  /// 5 ms.
  static constexpr double kFastest_n_s = 2000, kFastest_nm_s = 100;

  /// Limits in N and N m; `actuated_axes` (msg::AXIS_* bits): only what is exerted does work. 0: the device
  /// did not say, all of it counts.
  HandGuard(double max_force_n, double max_torque_nm, std::uint32_t actuated_axes)
      : max_force_n_(max_force_n), max_torque_nm_(max_torque_nm), axes_(actuated_axes) {}

  /// What to exert until the next call, of what is asked for.
  Wrench limit(const Wrench& asked, std::int64_t now_ns) noexcept;
  /// After it, the measurement of this period; `usable`: it says where the hand is. `simulated`: it came
  /// there under the newest command (Device::simulates()).
  void follow(const Measurement& measured, bool usable, bool simulated) noexcept;

  const node::EnergyTank& tank() const { return tank_; }
  /// In how many calls less was exerted than asked for, because the tank did not cover it.
  std::uint64_t held_back() const { return held_back_; }

 private:
  void rise_to(Wrench& wrench, double rise_s) const noexcept;
  void only_actuated(Vec3& force) const noexcept;
  bool drives_grip() const noexcept { return axes_ == 0 || (axes_ & msg::AXIS_GRIP) != 0; }
  double stored_j() noexcept;
  void act(bool simulated) noexcept;
  void reckon() noexcept;
  void arrive(const Measurement& measured) noexcept;

  double max_force_n_, max_torque_nm_;
  std::uint32_t axes_;
  node::EnergyTank tank_;
  std::uint64_t held_back_ = 0;

  Wrench asked_, exerted_, exerted_before_;
  // what acted since the newest measurement, times its time: the hand is taken to go evenly between two
  Vec3 impulse_ = Vec3::Zero(), angular_impulse_ = Vec3::Zero();  // N s, N m s
  double grip_impulse_ = 0;                                       // N m s
  double acted_s_ = 0;
  std::int64_t limited_ns_ = 0;
  bool limited_ = false;
  double period_s_ = 0, period_before_s_ = 0;  // of this call and of the one before

  bool known_place_ = false;
  std::int64_t measured_ns_ = 0;
  Vec3 tip_ = Vec3::Zero();
  Quat orientation_ = Quat::Identity();
  double grip_ = 0;  // rad
  node::HandMotion motion_;
  double way_s_ = 0;       // what the newest way took
  double reckoned_j_ = 0;  // charged since the newest measurement, as if the hand had gone on
  // where the hand was when it was last free
  Vec3 free_tip_ = Vec3::Zero();
  Quat free_orientation_ = Quat::Identity();
  double free_grip_ = 0;
};

}  // namespace omentum::device
