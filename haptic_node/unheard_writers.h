// Devices whose quality of service is too little for their topics: DDS hands on nothing of theirs.
#pragma once

#include "haptic_node/tool_line.h"

#include <atomic>
#include <memory>
#include <optional>
#include <span>

namespace omentum::haptic {

/// Makes faults of the writers of ToolPose and DeviceInfo that are refused. DDS does not say whose they are:
/// of poses, those devices are named that describe a tool of which no pose ever came.
class UnheardWriters {
 public:
  /// A device says its name when it starts; so long it is waited for, ns.
  static constexpr std::int64_t kNameWait_ns = 1'000'000'000;

  // ---- the vendor's threads; never wait

  void refused_poses(transport::QosPolicy policy) noexcept { add(policy, poses_); }
  void refused_infos(transport::QosPolicy policy) noexcept { add(policy, infos_); }

  // ---- the ordinary thread

  void tell(std::int64_t now_ns, std::span<const std::unique_ptr<ToolLine>> lines,
            runtime::FaultList& faults);

 private:
  using Policies = std::atomic<std::uint32_t>;  // bit p: that one

  static void add(transport::QosPolicy policy, Policies& to) noexcept {
    to.fetch_or(1u << static_cast<unsigned>(policy), std::memory_order_relaxed);
  }

  Policies poses_{0}, infos_{0};
  std::optional<std::int64_t> since_ns_;  // something waits to be told
};

}  // namespace omentum::haptic
