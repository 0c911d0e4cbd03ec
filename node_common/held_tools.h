// Which poses are those of the tools' holders, for who shows or follows tools and answers nobody.
#pragma once

#include "node_common/following_holder.h"
#include "runtime/mailbox.h"
#include "scene/scene.h"
#include "transport/latest.h"

#include <array>
#include <memory>
#include <string>

namespace omentum::node {

/// Decides as haptic_node does, from the same topics, and follows its answers (FollowingHolder), where the
/// scene names a tool's device; elsewhere everything counts. Hears DeviceInfo and ToolForce only where it has
/// to.
class HeldTools {
 public:
  HeldTools(transport::Bus& bus, const scene::Scene& scene);

  /// Of ToolPose; empty where the scene names no device. This must outlive its user. For one thread at a
  /// time.
  transport::LatestByTool<msg::ToolPose>::Admits admits();

 private:
  struct Tool {
    Tool(const std::string& device, std::int64_t silence_ns) : names(device), holder(silence_ns) {}

    DeviceRegister names;  // the thread of DeviceInfo
    runtime::Mailbox<KnownDevices> known;
    runtime::Mailbox<msg::Echo> answers;  // from their thread
    FollowingHolder holder;               // the thread of poses
    std::int64_t stamp_ns = 0;
  };

  transport::Admission admits(const msg::ToolPose& pose, const transport::WriterId& writer,
                              std::int64_t now_ns) noexcept;

  std::array<std::unique_ptr<Tool>, msg::MAX_TOOLS> tools_;  // those that have a device
  // last: their callbacks use the tools
  std::unique_ptr<transport::Reader<msg::DeviceInfo>> infos_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> answers_;
};

}  // namespace omentum::node
