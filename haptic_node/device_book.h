// What one tool may be asked for, by all who say they are its device.
#pragma once

#include "haptic_node/device_limits.h"
#include "transport/bus.h"

#include <array>
#include <optional>
#include <span>

namespace omentum::haptic {

/// The numbers of a DeviceInfo that are limits.
enum LimitField : std::uint8_t { kMaxForce, kMaxTorque, kMaxStiffness };
inline constexpr int kLimitFields = 3;
/// Its name in the IDL.
const char* describe(LimitField field) noexcept;

/// One that is none.
struct RefusedLimit {
  LimitField field = kMaxForce;
  double value = 0;
  LimitBounds expected;
};

/// The smallest of the limits of all living writers of a tool's DeviceInfo: nobody lifts what a device asked
/// for, and who leaves takes his limits with him. Of axes those count that all name who name some. When the
/// last one leaves, his limits hold until another one speaks: a device may only have been out of sight.
///
/// A number that is no limit (LimitBounds) is refused, and what held for this writer goes on, field by field;
/// for a new one, what holds for the tool. One thread at a time; allocates nothing.
class DeviceBook {
 public:
  /// Devices of one tool that are told apart; what more of them say holds for good.
  static constexpr std::size_t kWriters = 8;

  /// Returns what was refused; valid until the next call.
  std::span<const RefusedLimit> hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept;
  void gone(const transport::WriterId& writer) noexcept;

  const DeviceLimits& limits() const noexcept { return limits_; }

 private:
  struct Said {
    transport::WriterId writer{};
    std::optional<DeviceLimits> limits;  // none: a free place
  };

  void read(const msg::DeviceInfo& info, DeviceLimits& limits) noexcept;
  void combine() noexcept;

  std::array<Said, kWriters> said_;
  std::optional<DeviceLimits> further_;
  DeviceLimits limits_;
  std::array<RefusedLimit, kLimitFields> refused_;
  std::size_t refused_count_ = 0;
};

}  // namespace omentum::haptic
