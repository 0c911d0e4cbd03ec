// The node around the models: topics in, topics out, at a fixed rate.
#pragma once

#include "deform_node/served_organ.h"
#include "runtime/loop_log.h"
#include "runtime/node_options.h"
#include "runtime/rate_loop.h"

#include <nlohmann/json_fwd.hpp>

namespace omentum::deform {

struct DeformOptions {
  runtime::NodeOptions node;
  double rate_hz = 100;  // faster than any screen, slow beside a step (DESIGN 2 asks for 60 or more)
};

/// Takes Contact and SessionCommand, publishes OrganState, Topology, SceneInfo and NodeStatus.
class DeformLoop {
 public:
  /// Loads the scene and joins the domain. Throws what and where. `loop` sets the pace and must outlive this.
  DeformLoop(const DeformOptions& options, runtime::RateLoop& loop);

  /// Until loop.stop().
  void run();
  /// After run(): the node's object of report.json (DESIGN 5).
  nlohmann::json report() const;

 private:
  void tick() noexcept;
  void obey() noexcept;
  void publish(std::int64_t now_ns) noexcept;
  void publish_status() noexcept;
  void command(const msg::SessionCommand& command) noexcept;

  DeformOptions options_;
  runtime::Scene scene_;
  std::vector<ServedOrgan> organs_;
  runtime::FaultList faults_;
  ContactBook book_;
  runtime::RateLoop& loop_;
  std::unique_ptr<runtime::LoopLog> log_;
  std::atomic<bool> paused_{false};
  std::atomic<bool> reset_{false};
  std::uint64_t steps_ = 0;
  std::uint64_t states_ = 0;
  std::uint64_t ticks_ = 0;
  msg::NodeStatus status_{};

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> scene_writer_;
  std::unique_ptr<transport::Writer<msg::Topology>> topology_writer_;
  std::unique_ptr<transport::Writer<msg::OrganState>> state_writer_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> status_writer_;
  std::unique_ptr<transport::Reader<msg::Contact>> contact_reader_;
  std::unique_ptr<transport::Reader<msg::SessionCommand>> command_reader_;
};

}  // namespace omentum::deform
