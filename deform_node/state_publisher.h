// Writes what the loop hands over, on a thread of its own: a slow wire delays no step.
#pragma once

#include "deform_node/cut_journal.h"
#include "deform_node/organ_messages.h"
#include "deform_node/served_organ.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"
#include "runtime/woken_thread.h"
#include "transport/bus.h"

#include <vector>

namespace omentum::deform {

/// What the publisher writes to. All outlive it.
struct StateWriters {
  transport::Writer<msg::SceneInfo>& scene;
  transport::Writer<msg::Topology>& topology;
  transport::Writer<msg::OrganState>& state;
  transport::Writer<msg::NodeStatus>& status;
  CutJournal* journal = nullptr;  // none: cuts end with the process
};

/// Publishes the newest snapshot: before the first one who is in the scene, before a state the topology that
/// it belongs to, and that into the journal before it leaves, after it the status, if one is due. A snapshot
/// that came while another one was being written is passed over when there is a newer one. Destruction writes
/// the last one.
class StatePublisher {
 public:
  /// `info`, and `introduction`: what the node tells of itself; the faults are told with every status and
  /// outlive this. `start`: how the publishing thread is made.
  StatePublisher(const StateWriters& writers, const std::vector<ServedOrgan>& organs,
                 std::int32_t nodes_per_block, msg::SceneInfo info, msg::NodeStatus introduction,
                 const runtime::FaultList& faults, const runtime::StartWork& start);

  /// The loop's thread; neither waits nor allocates. Fill the draft wholly, then publish it.
  TickSnapshot& draft() noexcept { return newest_.draft(); }
  void publish() noexcept;

 private:
  void write_newest();
  void write_organ(OrganMessages& messages, const TickSnapshot& tick, const OrganSnapshot& snapshot);
  void write_status(const TickSnapshot& tick);

  StateWriters writers_;
  const runtime::FaultList& faults_;
  runtime::Mailbox<TickSnapshot> newest_;
  // the publishing thread's
  std::vector<OrganMessages> messages_;  // per organ
  msg::SceneInfo info_;
  bool scene_told_ = false;
  msg::NodeStatus status_;
  std::uint64_t status_told_ = 0;
  std::unique_ptr<runtime::WokenWork> writing_;  // last: it uses what is above
};

}  // namespace omentum::deform
