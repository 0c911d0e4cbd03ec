// Devices on the wire: the loop that a device's program runs.
#pragma once

#include "device_bridge/answer_book.h"
#include "device_bridge/ray_inbox.h"
#include "device_bridge/tool_channel.h"
#include "device_bridge/trace.h"
#include "node_common/loaded_scene.h"
#include "node_common/refusal.h"
#include "node_common/session_orders.h"
#include "runtime/faults.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/pace.h"
#include "runtime/realtime.h"
#include "transport/bus.h"

#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace omentum::device {

/// haptic_node lets no force outlive its pose by more than 25 ms: of poses that come less often a hand feels
/// next to nothing, Hz.
inline constexpr double kSlowestRate_hz = 40;

struct BridgeOptions {
  runtime::NodeOptions node;
  double rate_hz = 1000;
  std::optional<node::LoadedScene> scene;         // where the hands' tools stand; none: any session will do
  double seconds = 0;                             // 0: until stopped
  std::filesystem::path record;                   // the poses as a trace; empty: none
  std::map<std::uint32_t, MappingSpec> mappings;  // by tool; none: the device measures the tool in W itself
  RayInbox* rays = nullptr;  // takes what a window says of its pointer (MouseHand); outlives the bridge
};

/// Publishes DeviceInfo once, ToolPose every tick and NodeStatus twice a second; receives ToolForce, the
/// statuses that echo its poses, SessionCommand, and SceneInfo where the devices belong to a scene: another
/// one ends a bridge that has just started; after node::kSettled_s it is the newcomer's fault, and is
/// ignored. Asks for real-time priority.
class DeviceBridge {
 public:
  /// Joins the domain. Throws std::runtime_error saying what was refused. `loop` sets the pace, tells the
  /// time and must outlive this.
  DeviceBridge(const BridgeOptions& options, std::vector<std::unique_ptr<Device>> devices,
               const transport::OpenBus& open_bus, runtime::Pace& loop);
  ~DeviceBridge();

  /// Until loop.stop() or the end of `seconds`; then lets the hands go. Throws std::runtime_error when the
  /// session's scene is another one.
  void run();

  /// After run(): virtual_device's object of report.json.
  nlohmann::json report() const;
  /// After run(), and after the report: throws std::runtime_error when lines of the log or the record were
  /// lost, and why.
  void require_written();

 private:
  void connect(const transport::OpenBus& open_bus);
  void obey() noexcept;
  void exchange(ToolChannel& channel) noexcept;
  void receive(const msg::ToolForce& answer) noexcept;
  void hear(const msg::SceneInfo& other);
  void publish_status();

  BridgeOptions options_;
  runtime::Pace& loop_;
  std::int64_t start_ns_;
  runtime::FaultList faults_;
  AnswerBook answers_;
  std::vector<std::unique_ptr<ToolChannel>> channels_;
  runtime::RealtimeGrant realtime_;
  std::unique_ptr<runtime::LoopLog> log_;
  std::unique_ptr<TraceLog> record_;
  node::SessionOrders orders_;
  node::Refusal refusal_;
  runtime::Mailbox<runtime::LoopRecord> status_record_;  // from the loop to the status
  msg::NodeStatus status_message_;                       // the status thread's

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::DeviceInfo>> info_writer_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> pose_writer_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> force_reader_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> status_reader_;
  std::unique_ptr<transport::Reader<msg::SessionCommand>> command_reader_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scene_reader_;
  std::unique_ptr<transport::Reader<msg::PointerRay>> ray_reader_;
  std::unique_ptr<runtime::SideWork> status_;
};

}  // namespace omentum::device
