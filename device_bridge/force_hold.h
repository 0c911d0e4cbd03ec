// The device's side of force safety: what to exert between two answers, when they stop, and when they come
// back.
#pragma once

#include "device_bridge/device.h"

#include <cstdint>

namespace omentum::device {

/// Holds the newest answer for its valid_for_s, then lets it decay linearly to zero; bounds it by the
/// device's own limits. After the first answer and after each expiry the force may fall as it likes but rises
/// no faster than to the device's limit in kFadeIn_s. haptic_node cannot do this: it does not know that its
/// answers were lost on the way, and goes on as if they had been felt. Reads no clock. One thread.
class ForceHold {
 public:
  /// Within which a stale force vanishes: as fast as the haptic node's own decay is by default.
  static constexpr double kDecay_s = 0.02;
  /// From nothing to the device's limit, s: as long as haptic_node's own ramp after a reconnection (the
  /// scene's ramp_s), within the time a person takes to brace the hand.
  static constexpr double kFadeIn_s = 0.2;

  /// Limits in N and N m, finite and not negative.
  ForceHold(double max_force_n, double max_torque_nm)
      : max_force_n_(max_force_n), max_torque_nm_(max_torque_nm) {}

  /// Takes a new answer that arrived at `now_ns`. Returns false, and keeps the old one, when it is not
  /// finite.
  [[nodiscard]] bool take(const msg::ToolForce& answer, std::int64_t now_ns) noexcept;

  /// What to exert now. Zero before the first answer.
  Wrench at(std::int64_t now_ns) noexcept;

  /// Which answer (ToolForce.seq) at() gave last, whole, fading in or decaying; 0: none, or nothing is left.
  std::uint64_t answer_seq() const { return exerted_seq_; }
  /// How many times an answer outlived its validity.
  std::uint64_t expired() const { return expired_; }

 private:
  Wrench fading_in(std::int64_t now_ns) noexcept;
  Wrench decaying(double stale_s) noexcept;
  double effort(const Wrench& wrench) const noexcept;

  double max_force_n_, max_torque_nm_;
  Wrench newest_;
  std::uint64_t newest_seq_ = 0, exerted_seq_ = 0;
  Wrench exerted_;      // what at() gave last
  Wrench decays_from_;  // what was exerted when the newest answer expired
  std::int64_t valid_until_ns_ = 0;
  bool held_ = false;  // the newest answer has not expired
  std::uint64_t expired_ = 0;

  bool fades_in_ = false;
  std::int64_t fade_begin_ns_ = 0;
  double fade_begin_effort_ = 0;  // then, as a share of the limits
};

}  // namespace omentum::device
