// The device's side of force safety: what to exert between two answers, and when they stop.
#pragma once

#include "device_bridge/device.h"

#include <cstdint>

namespace omentum::device {

/// Holds the newest answer for its valid_for_s, then lets it decay linearly to zero; bounds it by the
/// device's own limits. Reads no clock. One thread.
class ForceHold {
 public:
  /// Within which a stale force vanishes: as fast as the haptic node's own decay (DESIGN 4).
  static constexpr double kDecay_s = 0.02;

  ForceHold(double max_force_n, double max_torque_nm)
      : max_force_n_(max_force_n), max_torque_nm_(max_torque_nm) {}

  /// Takes a new answer that arrived at `now_ns`. Returns false, and keeps the old one, when it is not
  /// finite.
  [[nodiscard]] bool take(const msg::ToolForce& answer, std::int64_t now_ns) noexcept;

  /// What to exert now. Zero before the first answer.
  Wrench at(std::int64_t now_ns) noexcept;

  /// How many times an answer outlived its validity.
  std::uint64_t expired() const { return expired_; }

 private:
  double max_force_n_, max_torque_nm_;
  Wrench newest_;
  std::int64_t valid_until_ns_ = 0;
  bool fresh_ = false;
  std::uint64_t expired_ = 0;
};

}  // namespace omentum::device
