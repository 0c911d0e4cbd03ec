// What the device may be exerting now, as far as haptic_node can know.
#pragma once

#include "haptic_node/wrench.h"

#include <array>
#include <cstddef>

namespace omentum::haptic {

/// The answers that were written last, and what a device makes of them: it holds each for its time of
/// validity, then lets it decay, and after that lets the next ones fade in (docs/devices.md). Whether one
/// arrived, and when the device turned to it,
/// nobody tells. One thread.
class ActingForce {
 public:
  /// `decay_s`: the time in which a device lets an expired force vanish.
  explicit ActingForce(double decay_s) : decay_s_(decay_s) {}

  /// The device's, N and N m: it fades in as shares of them.
  void set_limits(double max_force_n, double max_torque_nm) noexcept {
    max_force_n_ = max_force_n;
    max_torque_nm_ = max_torque_nm;
  }

  void age(double dt_s) noexcept { now_s_ += dt_s; }
  /// An answer was written `age_s` ago; from then on it holds for `valid_s`.
  void tell(const Wrench& wrench, double valid_s, double age_s) noexcept;

  /// Work on a hand that went one way, J, as two kinds of devices do it.
  struct Work {
    double soon_j = 0;  // it turns to an answer at once: the most that those written since the way began gave
    double late_j = 0;  // in its next period: the one that was written before
  };
  /// The way (m; rad, in W) took the last `took_s`, and the jaws opened by `opened_rad` on it.
  Work work(const Vec3& way, const Vec3& turn, double took_s, double opened_rad = 0) const noexcept;

 private:
  struct Told {
    Wrench wrench;
    double valid_s = 0, at_s = 0;
  };
  double share_at(const Told& told, double time_s) const noexcept;
  double faded_in(const Wrench& wrench) const noexcept;
  double work_of(const Told& told, double told_j, double begin_s) const noexcept;

  // those of the longest way between two poses of one connection: answers come at most every 1.5 ms without
  // a pose
  static constexpr std::size_t kTold = 32;

  double decay_s_, max_force_n_ = 0, max_torque_nm_ = 0;
  double now_s_ = 0, fade_begin_s_ = 0;
  std::array<Told, kTold> told_{};
  std::size_t newest_ = 0;
};

}  // namespace omentum::haptic
