// From Omentum's topics to those of ROS, tool by tool.
#pragma once

#include "node_common/session_orders.h"
#include "ros_bridge/crtk.h"
#include "ros_bridge/wire/ros_port.h"
#include "runtime/clock.h"
#include "transport/latest.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace omentum::ros {

struct RepublisherOptions {
  std::array<std::string, msg::MAX_TOOLS> names;  // the tools' namespaces
  std::string frame = "world";                    // what ROS calls W
  bool obeys = false;                             // state_command
};

/// Listens to ToolPose, ToolForce and NodeStatus, and publishes of each tool that was heard of measured_cp,
/// measured_cs and spatial/servo_cf at each tick(), and operating_state when it changes. Only where asked to
/// does it write SessionCommand. Nothing waits for it.
class Republisher {
 public:
  /// All must outlive this. Throws std::runtime_error where the vendor refuses.
  Republisher(RepublisherOptions options, transport::Bus& bus, RosPort& port, const runtime::Clock& clock);
  ~Republisher();

  /// One thread. `wall_ns`: now, since 1970. Throws as the constructor.
  void tick(std::int64_t wall_ns);

  bool has_tools() const;                             // one was heard of
  std::uint64_t refused() const { return refused_; }  // messages that the vendor did not take

 private:
  struct Tool;
  std::unique_ptr<Tool> begin(std::uint32_t id);
  ToolNow now(std::uint32_t id, std::int64_t wall_ns);
  void publish(Tool& tool, const ToolNow& now, std::int64_t wall_ns);
  void obey(Tool& tool);
  void send_copy();

  RepublisherOptions options_;
  RosPort& port_;
  const runtime::Clock& clock_;
  node::SessionOrders orders_;
  std::uint64_t sender_;
  std::uint64_t refused_ = 0;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::optional<msg::SessionCommand> copy_;  // of the newest command: a first sample may be lost
  std::int64_t copy_due_ns_ = 0;
  std::array<std::unique_ptr<Tool>, msg::MAX_TOOLS> tools_;
  transport::Arrived<msg::ToolPose> pose_;  // of the tool that is being published
  transport::Arrived<msg::ToolForce> force_;
  // last: their callbacks use what is above
  transport::LatestByTool<msg::ToolPose> poses_;
  transport::LatestByTool<msg::ToolForce> forces_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
};

}  // namespace omentum::ros
