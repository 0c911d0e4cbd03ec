// Who says of himself that he is a tool's device, and which of them the scene wants.
#pragma once

#include "transport/bus.h"

#include <array>
#include <string>
#include <string_view>

namespace omentum::node {

/// A device's name as the wire bounds it, ends with zero.
using DeviceName = std::array<char, msg::MAX_NAME + 1>;

/// What is known of the participants that describe a tool (DeviceInfo): trivially copied between threads.
struct KnownDevices {
  /// That are told apart. Of more of them those count that the scene wants.
  static constexpr std::size_t kMost = 8;
  struct Device {
    transport::WriterId writer{};  // of its DeviceInfo
    bool wanted = false;           // its name is the scene's for this tool
    DeviceName name{};
  };

  std::array<Device, kMost> devices{};
  std::size_t count = 0;

  bool wants(const transport::ParticipantId& who) const noexcept;
  /// A wanted one is there, besides `who`.
  bool another_wanted(const transport::ParticipantId& who) const noexcept;
  /// All zeros for one that did not say it.
  DeviceName name_of(const transport::ParticipantId& who) const noexcept;
};

/// Hears one tool's DeviceInfo. One thread at a time; allocates nothing.
class DeviceRegister {
 public:
  /// `wanted`: the name that the scene gives this tool's device; empty: none, and no one is wanted.
  explicit DeviceRegister(std::string wanted) : wanted_(std::move(wanted)) {}

  void hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept;
  void gone(const transport::WriterId& writer) noexcept;
  const KnownDevices& known() const noexcept { return known_; }

 private:
  std::string wanted_;
  KnownDevices known_;
};

}  // namespace omentum::node
