// Everything that render_node hears, handed from the vendor's threads to the one that draws.
#pragma once

#include "node_common/held_tools.h"
#include "node_common/session_orders.h"
#include "render_node/force_peaks.h"
#include "render_node/pose_arrivals.h"
#include "render_node/state_count.h"
#include "render_node/stress_pairing.h"
#include "runtime/clock.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"
#include "transport/latest.h"

#include <mutex>
#include <optional>

namespace omentum::render {

/// The fault of a state that no organ here has.
inline constexpr const char* kMisfitState = "organ state of another kind or size than the organ's";

/// An organ as this process loaded it.
struct LoadedOrgan {
  std::string name;
  std::string hash;
  std::size_t node_count = 0;  // of its states
  double reach_m = 0;          // a state that moves a node farther is none (plausible.h)
  std::uint32_t state_kind = msg::KIND_SURFACE;
  std::size_t tetrahedron_count = 0;  // 0: it is never cut
  std::size_t most_nodes = 0;         // of its states when cut
};

/// A contact and when it came (the inbox's clock).
struct HeardContact {
  msg::Contact contact;
  std::int64_t arrived_ns = 0;
};

/// A node's newest status and when it came (the inbox's clock).
struct HeardStatus {
  msg::NodeStatus status;
  std::int64_t arrived_ns = 0;
};
inline constexpr std::int64_t kSilent_ns =
    2'500'000'000;  // a node that says nothing for so long; they speak at 1 Hz
/// Keeps the newest run of deform_node and the picture, and of haptic and device nodes one per instance. Who
/// falls silent is forgotten after a while, but never haptic_node and deform_node: without them the session
/// is not whole, so they stay until they return. At most kMostHeard: then who is silent longest makes room.
/// `now_ns`: when `status` came.
inline constexpr std::size_t kMostHeard = 24;  // eight hands, their haptic_nodes, and some to spare
void remember_status(const msg::NodeStatus& status, std::int64_t now_ns, std::vector<HeardStatus>& heard);

/// Subscriptions. Callbacks only copy into mailboxes; all public calls are for the drawing thread, none
/// waits.
class Inbox {
 public:
  /// `clock` says when something came; `bus` and `clock` outlive this.
  Inbox(transport::Bus& bus, const scene::Scene& scene, const std::vector<LoadedOrgan>& organs,
        const runtime::Clock& clock, runtime::FaultList& faults);

  bool pose(std::uint32_t tool, transport::Arrived<msg::ToolPose>& out) const {
    return poses_.load(tool, out);
  }
  bool force(std::uint32_t tool, transport::Arrived<msg::ToolForce>& out) const {
    return forces_.load(tool, out);
  }
  /// When the pose came that an output echoes.
  std::optional<std::int64_t> arrival_of(std::uint32_t tool, std::uint64_t seq) const {
    return tool < arrivals_.size() ? arrivals_[tool].find(seq) : std::nullopt;
  }
  /// The newest contact of a tool with an organ; without nodes before one came.
  const HeardContact& contact(std::size_t organ, std::uint32_t tool);
  /// The newest state of an organ, with what was removed of it, if one came since the last call. A state that
  /// comes before its topology waits for it, until a newer one comes; one of a topology that is past is
  /// dropped.
  const AssembledState* fetch_state(std::size_t organ);
  /// Whether states come with what their tissue is under (OrganStress), which is read only then. A state
  /// waits for its own (stress_pairing.h).
  void read_stress(bool on);
  const std::vector<HeardStatus>& statuses();
  node::SessionOrders& orders() { return orders_; }
  ForcePeaks& force_peaks() { return force_peaks_; }
  const msg::SceneInfo* fetch_scene_info();
  std::uint64_t incomplete_states() const { return incomplete_states_.load(std::memory_order_relaxed); }
  /// Dropped for their topology, of all organs.
  std::uint64_t unmatched_states() const { return unmatched_states_.load(std::memory_order_relaxed); }
  /// Of all organs; for the report, since it waits for who listens.
  StateCounts state_counts() const;

 private:
  struct OrganBox {
    explicit OrganBox(const LoadedOrgan& organ);
    // States and topologies come on threads of their own and meet here. Never taken by who draws.
    std::mutex mutex;
    StateAssembly assembly;
    StateCount count;
    KnownTopologies topologies;
    std::optional<StressPairing> pairing;  // while stress is read
    std::size_t most_nodes;
    std::optional<AssembledState> early;  // its topology did not come yet
    runtime::Mailbox<AssembledState> newest;
    std::array<runtime::Mailbox<HeardContact>, msg::MAX_TOOLS> contacts;
  };
  void take_contact(const msg::Contact& contact);
  void take_state(const msg::OrganState& block);
  void take_topology(const msg::Topology& topology);
  void take_stress(const msg::OrganStress& block);
  void match(const AssembledState& state, OrganBox& organ);
  void post(const AssembledState& state, OrganBox& organ);
  void take_status(const msg::NodeStatus& status);

  transport::Bus& bus_;
  const runtime::Clock& clock_;
  runtime::FaultList& faults_;
  std::array<PoseArrivals, msg::MAX_TOOLS> arrivals_;
  ForcePeaks force_peaks_;
  node::HeldTools held_;
  transport::LatestByTool<msg::ToolPose> poses_;
  transport::LatestByTool<msg::ToolForce> forces_;
  std::vector<std::unique_ptr<OrganBox>> organs_;
  std::vector<HeardStatus> heard_;  // the status callback's own
  node::SessionOrders orders_;
  runtime::Mailbox<std::vector<HeardStatus>> statuses_;
  runtime::Mailbox<msg::SceneInfo> scene_info_;
  std::atomic<std::uint64_t> incomplete_states_{0}, unmatched_states_{0};

  // last: their callbacks use what is above
  std::unique_ptr<transport::Reader<msg::Contact>> contact_reader_;
  std::unique_ptr<transport::Reader<msg::OrganState>> state_reader_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> status_reader_;
  std::unique_ptr<transport::Reader<msg::SessionCommand>> command_reader_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scene_reader_;
  std::unique_ptr<transport::Reader<msg::Topology>> topology_reader_;
  std::unique_ptr<transport::Reader<msg::OrganStress>> stress_reader_;  // while stress is read
};

}  // namespace omentum::render
