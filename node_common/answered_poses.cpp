#include "node_common/answered_poses.h"

#include <algorithm>

namespace omentum::node {

void AnsweredPoses::heard(const transport::ParticipantId& who, std::uint64_t seq,
                          std::int64_t stamp_ns) noexcept {
  auto device = std::ranges::find_if(devices_, [&](const Device& d) { return d.heard > 0 && d.who == who; });
  if (device == devices_.end()) {
    device = std::ranges::min_element(devices_, {}, &Device::heard);
    *device = {};
    device->who = who;
  }
  device->heard = ++poses_;
  device->sent[seq % kPoses] = {true, seq, stamp_ns};
}

std::optional<transport::ParticipantId> AnsweredPoses::sender_of(const msg::Echo& answered) const noexcept {
  for (const Device& device : devices_) {
    const Sent& sent = device.sent[answered.seq % kPoses];
    if (sent.was && sent.seq == answered.seq && sent.stamp_ns == answered.stamp_ns) return device.who;
  }
  return std::nullopt;
}

}  // namespace omentum::node
