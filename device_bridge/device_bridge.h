// Devices on the wire: the loop that a device's program runs.
#pragma once

#include "device_bridge/answer_book.h"
#include "device_bridge/tool_channel.h"
#include "device_bridge/trace.h"
#include "node_common/session_orders.h"
#include "runtime/background.h"
#include "runtime/faults.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/rate_loop.h"
#include "runtime/realtime.h"
#include "transport/bus.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <vector>

namespace omentum::device {

/// haptic_node lets no force outlive its pose by more than 25 ms: of poses that come less often a hand feels
/// next to nothing, Hz.
inline constexpr double kSlowestRate_hz = 40;

struct BridgeOptions {
  runtime::NodeOptions node;
  double seconds = 0;            // 0: until stopped
  std::filesystem::path record;  // the poses as a trace; empty: none
};

/// Publishes DeviceInfo once, ToolPose every tick and NodeStatus twice a second; receives ToolForce, the
/// statuses that echo its poses, and SessionCommand. Asks for real-time priority.
class DeviceBridge {
 public:
  /// Joins the domain. Throws std::runtime_error saying what was refused. `loop` must outlive this.
  DeviceBridge(const BridgeOptions& options, std::vector<std::unique_ptr<Device>> devices,
               runtime::RateLoop& loop);
  ~DeviceBridge();

  /// Until loop.stop() or the end of `seconds`; then lets the hands go.
  void run();

  /// After run(): virtual_device's object of report.json.
  nlohmann::json report() const;
  /// After run(), and after the report: throws std::runtime_error when lines of the log or the record were
  /// lost, and why.
  void require_written();

 private:
  void connect();
  void obey() noexcept;
  void exchange(ToolChannel& channel) noexcept;
  void receive(const msg::ToolForce& answer) noexcept;
  void publish_status();

  BridgeOptions options_;
  runtime::RateLoop& loop_;
  runtime::FaultList faults_;
  AnswerBook answers_;
  std::vector<std::unique_ptr<ToolChannel>> channels_;
  runtime::RealtimeGrant realtime_;
  std::unique_ptr<runtime::LoopLog> log_;
  std::unique_ptr<TraceLog> record_;
  node::SessionOrders orders_;
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
  std::unique_ptr<runtime::Background> status_;
};

}  // namespace omentum::device
