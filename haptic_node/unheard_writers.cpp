#include "haptic_node/unheard_writers.h"

#include "scene/scene_values.h"
#include "transport/refused_writers.h"

namespace omentum::haptic {
namespace {

using transport::QosPolicy;

// what a reader that asks who is gone requests
template <class M>
std::string offer(QosPolicy policy) {
  return transport::what_to_offer(transport::requested(transport::kTopicSpec<M>, true), policy);
}

template <class Tell>
void for_each_policy(std::uint32_t bits, Tell&& tell) {
  for (unsigned p = 0; bits >> p != 0; ++p)
    if (bits >> p & 1u) tell(static_cast<QosPolicy>(p));
}

// Whether somebody could be named. The name is last: it may be too long for a fault.
bool name_devices(QosPolicy policy, ToolLine& line, runtime::FaultList& faults) {
  const PoseCounts counts = line.counts();
  const node::KnownDevices& known = line.described();
  if (counts.accepted + counts.refused > 0) return false;
  for (std::size_t i = 0; i < known.count; ++i)
    faults.raise("tool " + std::to_string(line.id()) + ": poses not heard, " + offer<msg::ToolPose>(policy) +
                 ": '" + scene::printable(known.devices[i].name.data()) + "'");
  return known.count > 0;
}

}  // namespace

void UnheardWriters::tell(std::int64_t now_ns, std::span<const std::unique_ptr<ToolLine>> lines,
                          runtime::FaultList& faults) {
  if ((poses_.load(std::memory_order_relaxed) | infos_.load(std::memory_order_relaxed)) == 0) return;
  if (!since_ns_) since_ns_ = now_ns;
  if (now_ns - *since_ns_ < kNameWait_ns) return;
  since_ns_.reset();
  for_each_policy(poses_.exchange(0, std::memory_order_relaxed), [&](QosPolicy policy) {
    bool named = false;
    for (const auto& line : lines) named = name_devices(policy, *line, faults) || named;
    if (!named) faults.raise("tool_pose: a writer is not heard, " + offer<msg::ToolPose>(policy));
  });
  for_each_policy(infos_.exchange(0, std::memory_order_relaxed), [&](QosPolicy policy) {
    faults.raise("device_info: a writer is not heard, " + offer<msg::DeviceInfo>(policy));
  });
}

}  // namespace omentum::haptic
