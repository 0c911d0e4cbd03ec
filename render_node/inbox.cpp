#include "render_node/inbox.h"

#include <algorithm>
#include <utility>

namespace omentum::render {
namespace {

constexpr std::int64_t kForgotten_ns = 10'000'000'000;  // a node silent for so long leaves the panel

bool forgotten(const HeardStatus& heard, std::int64_t now_ns) {
  const bool needed = heard.status.kind == msg::NODE_HAPTIC || heard.status.kind == msg::NODE_DEFORM;
  return !needed && now_ns - heard.arrived_ns > kForgotten_ns;
}

// Whether `status` speaks for a later run of the same node. One deform_node and one picture are the rule;
// hands and their haptic_nodes may be many, so there only a silent one is succeeded.
bool succeeds(const msg::NodeStatus& status, const HeardStatus& heard, std::int64_t now_ns) {
  if (heard.status.kind != status.kind || status.kind == msg::NODE_DEVICE) return false;
  return status.kind != msg::NODE_HAPTIC || now_ns - heard.arrived_ns > kSilent_ns;
}

}  // namespace

void remember_status(const msg::NodeStatus& status, std::int64_t now_ns, std::vector<HeardStatus>& heard) {
  std::erase_if(heard, [&](const HeardStatus& h) { return forgotten(h, now_ns); });
  auto place = std::find_if(heard.begin(), heard.end(), [&](const HeardStatus& h) {
    return h.status.kind == status.kind && h.status.instance == status.instance;
  });
  if (place == heard.end())
    place = std::find_if(heard.begin(), heard.end(),
                         [&](const HeardStatus& h) { return succeeds(status, h, now_ns); });
  if (place == heard.end() && heard.size() == kMostHeard) {
    place = std::min_element(heard.begin(), heard.end(),
                             [](const auto& a, const auto& b) { return a.arrived_ns < b.arrived_ns; });
    *place = {status, now_ns};
  } else if (place == heard.end()) {
    heard.push_back({status, now_ns});
  } else if (status.instance >= place->status.instance || now_ns - place->arrived_ns > kSilent_ns) {
    *place = {status, now_ns};
  }  // else a late sample of the old run
  std::sort(heard.begin(), heard.end(), [](const HeardStatus& a, const HeardStatus& b) {
    return std::pair(a.status.kind, a.status.instance) < std::pair(b.status.kind, b.status.instance);
  });
}

Inbox::Inbox(transport::Bus& bus, const scene::Scene& scene, const std::vector<LoadedOrgan>& organs,
             const runtime::Clock& clock, runtime::FaultList& faults)
    : bus_(bus),
      clock_(clock),
      faults_(faults),
      held_(bus, scene),
      poses_(
          bus, [this](const msg::ToolPose& p) { arrivals_[p.tool].add(p.seq, clock_.now_ns()); },
          [this] { return clock_.now_ns(); }, held_.admits()),
      forces_(
          bus, [this](const msg::ToolForce& force) { force_peaks_.take(force); },
          [this] { return clock_.now_ns(); }),
      orders_(clock_.now_ns()) {
  for (const LoadedOrgan& organ : organs) organs_.push_back(std::make_unique<OrganBox>(organ));
  contact_reader_ = bus.reader<msg::Contact>([this](const msg::Contact& contact) { take_contact(contact); });
  state_reader_ = bus.reader<msg::OrganState>([this](const msg::OrganState& block) { take_state(block); });
  status_reader_ =
      bus.reader<msg::NodeStatus>([this](const msg::NodeStatus& status) { take_status(status); });
  command_reader_ = bus.reader<msg::SessionCommand>(
      [this](const msg::SessionCommand& command) { orders_.hear(command, clock_.now_ns()); });
  scene_reader_ = bus.reader<msg::SceneInfo>([this](const msg::SceneInfo& info) { scene_info_.post(info); });
  topology_reader_ =
      bus.reader<msg::Topology>([this](const msg::Topology& topology) { take_topology(topology); });
}

void Inbox::take_contact(const msg::Contact& contact) {
  if (contact.tool >= msg::MAX_TOOLS) return;
  if (contact.organ >= organs_.size())
    return faults_.raise("contact with an organ that the scene does not have");
  organs_[contact.organ]->contacts[contact.tool].post({contact, clock_.now_ns()});
}

Inbox::OrganBox::OrganBox(const LoadedOrgan& organ)
    : assembly(organ.state_kind, {organ.node_count, std::max(organ.node_count, organ.most_nodes)},
               organ.reach_m),
      topologies(organ.tetrahedron_count),
      most_nodes(std::max(organ.node_count, organ.most_nodes)) {}

void Inbox::read_stress(bool on) {
  if (on == (stress_reader_ != nullptr)) return;
  stress_reader_.reset();  // no callback runs any more
  for (const auto& organ : organs_) {
    const std::lock_guard lock(organ->mutex);
    organ->pairing.reset();
    if (on) organ->pairing.emplace(organ->most_nodes);
  }
  if (on)
    stress_reader_ =
        bus_.reader<msg::OrganStress>([this](const msg::OrganStress& block) { take_stress(block); });
}

void Inbox::take_stress(const msg::OrganStress& block) {
  if (block.organ >= organs_.size())
    return faults_.raise("organ stress of an organ that the scene does not have");
  OrganBox& organ = *organs_[block.organ];
  const std::lock_guard lock(organ.mutex);
  if (!organ.pairing) return;
  if (!organ.pairing->take(block)) return faults_.raise("organ stress of another size than the organ's");
  if (const auto pair = organ.pairing->pair(clock_.now_ns())) post(*pair, organ);
}

void Inbox::take_state(const msg::OrganState& block) {
  if (block.organ >= organs_.size())
    return faults_.raise("organ state of an organ that the scene does not have");
  OrganBox& organ = *organs_[block.organ];
  const std::lock_guard lock(organ.mutex);
  const auto outcome = organ.assembly.take(block, [&](const AssembledState& state) {
    organ.count.shown(state.seq, state.missing_blocks);
    if (state.missing_blocks > 0) incomplete_states_.fetch_add(1, std::memory_order_relaxed);
    match(state, organ);
  });
  if (outcome == StateAssembly::Outcome::kMisfit) faults_.raise(kMisfitState);
}

void Inbox::take_topology(const msg::Topology& topology) {
  if (topology.organ >= organs_.size())
    return faults_.raise("topology of an organ that the scene does not have");
  OrganBox& organ = *organs_[topology.organ];
  const std::lock_guard lock(organ.mutex);
  if (!organ.topologies.take(topology)) return faults_.raise("topology of another organ than the scene's");
  if (organ.early && organ.topologies.removed_in(organ.early->topology_version))
    match(*std::exchange(organ.early, std::nullopt), organ);
}

// The organ's mutex is held.
void Inbox::match(const AssembledState& state, OrganBox& organ) {
  if (organ.early) unmatched_states_.fetch_add(1, std::memory_order_relaxed);
  organ.early.reset();
  if (const RemovedSet* removed = organ.topologies.removed_in(state.topology_version)) {
    AssembledState whole = state;
    whole.removed = *removed;
    if (!organ.pairing) {
      post(whole, organ);
    } else if (const auto now = organ.pairing->take(whole, clock_.now_ns())) {
      post(*now, organ);
    }
  } else if (state.topology_version > organ.topologies.highest()) {
    organ.early = state;
  } else {
    unmatched_states_.fetch_add(1, std::memory_order_relaxed);
  }
}

// The organ's mutex is held.
void Inbox::post(const AssembledState& state, OrganBox& organ) {
  organ.newest.draft() = state;
  organ.newest.post();
}

void Inbox::take_status(const msg::NodeStatus& status) {
  const std::int64_t now_ns = clock_.now_ns();
  orders_.hear(status, now_ns);
  remember_status(status, now_ns, heard_);
  statuses_.post(heard_);
}

StateCounts Inbox::state_counts() const {
  StateCounts sum;
  for (const auto& organ : organs_) {
    const std::lock_guard lock(organ->mutex);
    sum += organ->count.counts();
  }
  return sum;
}

const HeardContact& Inbox::contact(std::size_t organ, std::uint32_t tool) {
  auto& newest = organs_[organ]->contacts[tool];
  newest.fetch();
  return newest.value();
}

const AssembledState* Inbox::fetch_state(std::size_t organ) {
  auto& newest = organs_[organ]->newest;
  return newest.fetch() ? &newest.value() : nullptr;
}

const std::vector<HeardStatus>& Inbox::statuses() {
  statuses_.fetch();
  return statuses_.value();
}

const msg::SceneInfo* Inbox::fetch_scene_info() {
  return scene_info_.fetch() ? &scene_info_.value() : nullptr;
}

}  // namespace omentum::render
