#include "node_common/known_devices.h"

#include <algorithm>
#include <span>

namespace omentum::node {
namespace {

using Device = KnownDevices::Device;

std::span<const Device> all_of(const KnownDevices& known) noexcept {
  return {known.devices.data(), known.count};
}

bool is_of(const Device& device, const transport::ParticipantId& who) noexcept {
  return transport::participant_of(device.writer) == who;
}

}  // namespace

bool KnownDevices::wants(const transport::ParticipantId& who) const noexcept {
  return std::ranges::any_of(all_of(*this), [&](const Device& d) { return d.wanted && is_of(d, who); });
}

bool KnownDevices::another_wanted(const transport::ParticipantId& who) const noexcept {
  return std::ranges::any_of(all_of(*this), [&](const Device& d) { return d.wanted && !is_of(d, who); });
}

DeviceName KnownDevices::name_of(const transport::ParticipantId& who) const noexcept {
  for (const Device& device : all_of(*this))
    if (is_of(device, who)) return device.name;
  return {};
}

void DeviceRegister::hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept {
  Device device{.writer = writer, .wanted = !wanted_.empty() && info.name == wanted_};
  std::copy_n(info.name.begin(), std::min(info.name.size(), device.name.size() - 1), device.name.begin());
  const std::span<Device> all(known_.devices.data(), known_.count);
  auto place = std::ranges::find(all, writer, &Device::writer);
  if (place == all.end() && known_.count < KnownDevices::kMost) {
    known_.devices[known_.count++] = device;
    return;
  }
  // however many strangers describe the tool, the wanted one has room
  if (place == all.end() && device.wanted) place = std::ranges::find(all, false, &Device::wanted);
  if (place != all.end()) *place = device;
}

void DeviceRegister::gone(const transport::WriterId& writer) noexcept {
  const std::span<Device> all(known_.devices.data(), known_.count);
  const auto end =
      std::remove_if(all.begin(), all.end(), [&](const Device& d) { return d.writer == writer; });
  known_.count = static_cast<std::size_t>(end - all.begin());
}

}  // namespace omentum::node
