// The node around the step: threads, topics, clocks.
#pragma once

#include "haptic_node/contact_teller.h"
#include "haptic_node/hand_account.h"
#include "haptic_node/hand_over_log.h"
#include "haptic_node/haptic_log.h"
#include "haptic_node/haptic_setup.h"
#include "haptic_node/local_models.h"
#include "haptic_node/serving_claim.h"
#include "haptic_node/tool_line.h"
#include "haptic_node/unheard_writers.h"
#include "node_common/loaded_scene.h"
#include "node_common/refusal.h"
#include "node_common/session_orders.h"
#include "runtime/node_options.h"
#include "runtime/pace.h"
#include "runtime/realtime.h"
#include "transport/bus.h"

#include <nlohmann/json_fwd.hpp>

namespace omentum::haptic {

/// What haptic_node's command line asks for.
struct HapticOptions {
  runtime::NodeOptions node;
  double rate_hz = 1000;  // held without a device; the period against which a miss is counted
  std::span<const scene::OrganModelWord> models = scene::kOrganModels;  // that its scenes may choose from
};

/// Takes ToolPose, DeviceInfo, LocalModel, SessionCommand, SceneInfo; publishes ToolForce, Contact,
/// NodeStatus.
///
/// Three kinds of threads. The vendor's put poses through the guard into mailboxes and wake the loop. The
/// loop (run(), real-time where permitted) steps and writes forces at once; it waits for nobody. An ordinary
/// one tells the node's status. While the node is young, a tool goes to another node with the better claim,
/// and the loop ends when none is left or the scene is another. Once it is settled, whatever others say is a
/// fault and changes nothing: nobody loses a tool in the middle of a press.
class HapticLoop {
 public:
  /// Loads scene and organ and joins the domain. Throws what and where. `loop` sets the pace, tells the time
  /// and must outlive this.
  HapticLoop(const HapticOptions& options, const transport::OpenBus& open_bus, runtime::Pace& loop);
  ~HapticLoop();

  /// Until loop.stop(). Throws std::runtime_error when this node must not serve (a tool that another node
  /// serves, another organ).
  void run();
  /// After run(): the node's object of report.json.
  nlohmann::json report() const;
  /// After run(), and after the report: throws std::runtime_error when lines of the log were lost, and why.
  void require_written();

 private:
  // what the ordinary thread needs of the loop, a copy now and then
  struct Snapshot {
    runtime::LoopRecord record;
    std::array<msg::Echo, msg::MAX_TOOLS> echoes;
  };

  void connect(const transport::OpenBus& open_bus);
  void tick(std::int64_t now_ns) noexcept;
  void obey() noexcept;
  void answer(std::int64_t now_ns, double dt_s) noexcept;
  void tell_contacts(std::int64_t now_ns) noexcept;
  void account() noexcept;
  void note(std::size_t line, const msg::ToolForce& force) noexcept;

  void hear(const msg::ToolPose& pose, const transport::WriterId& writer) noexcept;
  void hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept;
  void hear(const msg::SceneInfo& scene);
  void hear(const msg::NodeStatus& other);
  void tell(const Dispute& dispute);
  bool serves(std::size_t line) const noexcept {
    return served_.load(std::memory_order_relaxed) >> lines_[line]->id() & 1u;
  }
  void publish_status();
  void tell_hand_overs();

  HapticOptions options_;
  HapticSetup setup_;
  runtime::FaultList faults_;
  runtime::Pace& loop_;
  std::unique_ptr<HapticLog> log_;
  runtime::RealtimeGrant grant_;

  // the loop's thread
  HapticState state_;
  HapticWorkspace work_;
  std::vector<std::unique_ptr<ToolLine>> lines_;  // [tools]
  std::vector<ToolInput> inputs_;
  std::vector<ToolOutput> outputs_;
  std::vector<HandAccount> accounts_;  // [tools]
  std::vector<bool> fresh_;
  std::vector<std::int64_t> answered_ns_;
  std::vector<ToolNews> news_;
  ContactTeller teller_;
  StepResult result_;
  std::uint64_t ticks_ = 0, ticks_in_contact_ = 0, force_samples_ = 0;
  std::int64_t last_tick_ns_ = 0, serve_from_ns_ = 0;
  double force_sum_n_ = 0, force_max_n_ = 0;
  int nodes_max_ = 0, neighbourhood_max_ = 0;

  // from the vendor's threads to the loop's
  node::SessionOrders orders_;
  runtime::Mailbox<Snapshot> snapshots_;

  node::Refusal refusal_;
  msg::NodeStatus status_;
  std::vector<HandOverLog> hand_overs_;  // [tools] the ordinary thread's
  UnheardWriters unheard_;
  node::Rivals rivals_;                                               // the status reader's thread
  std::atomic<node::Standing> standing_{node::Standing::kListening};  // as the last status told
  std::atomic<std::uint32_t> served_;                                 // bit t: answers for tool t

  // declared last: callbacks and threads end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolForce>> force_writer_;
  std::unique_ptr<transport::Writer<msg::Contact>> contact_writer_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<LocalModels> local_models_;  // where an organ is felt by them
  std::unique_ptr<transport::Reader<msg::LocalModel>> local_reader_;
  std::unique_ptr<transport::Reader<msg::ToolPose>> pose_reader_;
  std::unique_ptr<transport::Reader<msg::DeviceInfo>> device_reader_;
  std::unique_ptr<transport::Reader<msg::SessionCommand>> command_reader_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scene_reader_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> node_reader_;
  std::unique_ptr<runtime::SideWork> statuses_, looks_;
};

}  // namespace omentum::haptic
