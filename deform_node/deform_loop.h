// The node around the models: topics in, topics out, at a fixed rate.
#pragma once

#include "deform_node/cut_score.h"
#include "deform_node/local_publisher.h"
#include "deform_node/organ_group.h"
#include "deform_node/owed_time.h"
#include "deform_node/standby.h"
#include "deform_node/state_publisher.h"
#include "deform_node/stress_publisher.h"
#include "deform_node/time_account.h"
#include "deform_node/touch_publisher.h"
#include "node_common/loaded_scene.h"
#include "node_common/refusal.h"
#include "node_common/session_orders.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/pace.h"

#include <nlohmann/json_fwd.hpp>

namespace omentum::deform {

/// What deform_node's command line asks for, and the models that its scenes may choose from.
struct DeformOptions {
  runtime::NodeOptions node;
  std::filesystem::path journal;  // of cuts; empty: a node that is started again begins with whole organs
  double rate_hz = 100;           // faster than any screen, slow beside a step (docs/topics.md promises 60)
  std::span<const ModelEntry> models = model_table();
};

/// Takes Contact, SessionCommand, SceneInfo and NodeStatus; publishes OrganState, Topology, SceneInfo,
/// NodeStatus, LocalModel where organs offer any, and OrganStress and TouchingPairs while somebody reads
/// them. Listens first: who finds a scene with other organs does not join it, and who finds one that is
/// served stands by, silent but for Contact, until it is not. Another scene that appears after
/// node::kSettled_s is the newcomer's fault, and is ignored.
class DeformLoop {
 public:
  /// Loads the scene and joins the domain. Throws what and where. `loop` sets the pace, tells the time and
  /// must outlive this.
  DeformLoop(const DeformOptions& options, const transport::OpenBus& open_bus, runtime::Pace& loop);

  /// Until loop.stop(). Throws std::runtime_error when another deform_node serves other organs.
  void run();
  /// After run(): the node's object of report.json.
  nlohmann::json report() const;
  /// After run(), and after the report: throws std::runtime_error when lines of the log were lost, and why.
  void require_written();

 private:
  /// Null where none is asked for.
  std::unique_ptr<CutJournal> open_journal();
  void open_writers();
  void open_readers();
  void serve_or_stand_by();
  void take_up();
  void stand_by();
  void hear(const msg::SceneInfo& other);
  void tick() noexcept;
  void live_on() noexcept;
  void obey() noexcept;
  void score() noexcept;
  void take_figures() noexcept;
  void publish(std::int64_t now_ns) noexcept;

  DeformOptions options_;
  scene::Scene scene_;
  runtime::FaultList faults_;
  OrganGroup organs_;
  ContactBook book_;
  ScoredCut score_;
  runtime::Pace& loop_;
  std::unique_ptr<runtime::LoopLog> log_;
  node::LoadedScene loaded_;
  std::unique_ptr<CutJournal> journal_;
  std::int64_t start_ns_;
  node::SessionOrders orders_;
  node::Refusal refusal_;
  std::uint64_t states_ = 0;
  std::uint64_t ticks_ = 0;
  enum class Role { kListening, kServing, kStandingBy };
  Role role_ = Role::kListening;
  bool told_standing_by_ = false, told_serving_ = false;  // on stderr
  msg::NodeStatus own_;  // who this is; what of it changes is the publisher's, but for the ticks
  LoopFigures figures_;
  TimeAccount time_;
  OwedTime owed_;
  bool in_time_ = true;  // the last tick ended within its period
  Standby standby_;

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> scene_writer_;
  std::unique_ptr<transport::Writer<msg::Topology>> topology_writer_;
  std::unique_ptr<transport::Writer<msg::OrganState>> state_writer_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<transport::Writer<msg::LocalModel>> local_writer_;  // none where no organ offers any
  std::unique_ptr<transport::Writer<msg::OrganStress>> stress_writer_;
  std::unique_ptr<transport::Writer<msg::TouchingPairs>> touch_writer_;
  std::unique_ptr<StatePublisher> publisher_;
  std::unique_ptr<StressPublisher> stress_publisher_;
  std::unique_ptr<TouchPublisher> touch_publisher_;
  std::unique_ptr<LocalPublisher> local_publisher_;
  std::unique_ptr<ToolPlaces> tool_places_;  // where some organ offers local models
  std::unique_ptr<transport::Reader<msg::Contact>> contact_reader_;
  std::unique_ptr<transport::Reader<msg::SessionCommand>> command_reader_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scene_reader_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> node_reader_;
};

}  // namespace omentum::deform
