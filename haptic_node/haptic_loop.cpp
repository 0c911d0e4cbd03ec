#include "haptic_node/haptic_loop.h"

#include "files/console.h"
#include "haptic_node/enclosed_tool.h"
#include "node_common/link_write.h"
#include "node_common/node_identity.h"
#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <thread>

namespace omentum::haptic {
namespace {

// How long to listen for a node that serves these tools already. Most find each other within a second; two
// Fast participants may need 2.9 s, and who is found late is judged by its standing.
constexpr std::int64_t kListen_ns = 1'000'000'000;

constexpr std::chrono::milliseconds kStatusPeriod{100};
constexpr std::chrono::milliseconds kLookPeriod{20};  // for local models that are not told any more

// A tick never counts for longer than this: after a stall forces go on from where they were, s.
constexpr double kLongestTick_s = 0.02;

// A tool without a new pose is answered again after this many periods: the decay of a force must be told too.
constexpr double kAnswerAgainPeriods = 1.5;

std::uint32_t bits_of(const std::vector<std::uint32_t>& tools) {
  std::uint32_t bits = 0;
  for (const std::uint32_t tool : tools) bits |= 1u << tool;
  return bits;
}

}  // namespace

HapticLoop::HapticLoop(const HapticOptions& options, const transport::OpenBus& open_bus, runtime::Pace& loop)
    : options_(options),
      setup_(make_setup(node::load_scene(options.node), options.rate_hz, options.models)),
      loop_(loop),
      state_(setup_.model),
      work_(setup_.model),
      teller_(setup_.model, setup_.tool_ids, state_, work_.bodies),
      orders_(loop_.now_ns()),
      refusal_(loop),
      status_(node::introduce(msg::NODE_HAPTIC, options.rate_hz)),
      rivals_(msg::NODE_HAPTIC, status_.instance),
      served_(bits_of(setup_.tool_ids)) {
  if (!options.node.log.empty()) {
    log_ = std::make_unique<HapticLog>(options.node.log, setup_.tool_ids);
    loop_.log_to(*log_);
  }
  for (std::size_t i = 0; i < setup_.tool_ids.size(); ++i)
    lines_.push_back(
        std::make_unique<ToolLine>(setup_.tool_ids[i], setup_.limits, faults_, setup_.devices[i]));
  hand_overs_.resize(lines_.size());
  inputs_.resize(lines_.size());
  outputs_.resize(lines_.size());
  accounts_.resize(lines_.size());
  fresh_.resize(lines_.size());
  news_.resize(lines_.size());
  answered_ns_.resize(lines_.size());
  if (!setup_.local_organs.empty()) {
    const auto on_wake = [this](std::function<void()> work) { return loop_.on_wake(std::move(work)); };
    local_models_ = std::make_unique<LocalModels>(setup_, work_.doors, faults_, loop_, on_wake);
  }
  connect(open_bus);
}

HapticLoop::~HapticLoop() = default;

void HapticLoop::connect(const transport::OpenBus& open_bus) {
  const runtime::RealtimeStart start(runtime::kHandLinkPriority);
  bus_ = open_bus();
  force_writer_ = bus_->writer<msg::ToolForce>();
  contact_writer_ = bus_->writer<msg::Contact>();
  status_writer_ = bus_->writer<msg::NodeStatus>();
  if (local_models_)
    local_reader_ =
        bus_->reader<msg::LocalModel>([this](const msg::LocalModel& model) { local_models_->hear(model); });
  pose_reader_ = bus_->reader<msg::ToolPose>(transport::ByWriter<msg::ToolPose>{
      [this](const msg::ToolPose& pose, const transport::WriterId& writer) { hear(pose, writer); },
      [](const transport::WriterId&) {},  // who left is silent
      [this](transport::QosPolicy policy) { unheard_.refused_poses(policy); }});
  device_reader_ = bus_->reader<msg::DeviceInfo>(transport::ByWriter<msg::DeviceInfo>{
      [this](const msg::DeviceInfo& info, const transport::WriterId& writer) { hear(info, writer); },
      [this](const transport::WriterId& writer) {
        for (const auto& line : lines_) line->gone(writer);
      },
      [this](transport::QosPolicy policy) { unheard_.refused_infos(policy); }});
  command_reader_ = bus_->reader<msg::SessionCommand>(
      [this](const msg::SessionCommand& command) { orders_.hear(command, loop_.now_ns()); });
  scene_reader_ = bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& scene) { hear(scene); });
  node_reader_ = bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& other) { hear(other); });
}

// ---- the vendor's threads

void HapticLoop::hear(const msg::ToolPose& pose, const transport::WriterId& writer) noexcept {
  const transport::ParticipantId who = transport::participant_of(writer);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (lines_[i]->id() != pose.tool || !serves(i)) continue;
    if (lines_[i]->hear(pose, loop_.now_ns(), who)) loop_.wake();
  }
}

void HapticLoop::hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept {
  for (const auto& line : lines_) {
    if (line->id() == info.tool) line->hear(info, writer);
  }
}

void HapticLoop::hear(const msg::SceneInfo& scene) {
  auto why = node::contradicts(setup_.scene, scene);
  if (!why) return;
  if (standing_.load(std::memory_order_relaxed) == node::Standing::kSettled) {
    faults_.raise(node::kForeignScene);
  } else {
    refusal_.because(*std::move(why));
  }
}

void HapticLoop::hear(const msg::NodeStatus& other) {
  const std::int64_t now_ns = loop_.now_ns();
  orders_.hear(other, now_ns);
  if (!rivals_.proven(other, now_ns)) return;
  const ServingClaim own{{status_.instance, standing_.load(std::memory_order_relaxed)},
                         served_.load(std::memory_order_relaxed)};
  const Dispute dispute = judge(own, other);
  tell(dispute);
  served_.store(own.tools_served & ~dispute.given_up, std::memory_order_relaxed);
  if (dispute.given_up != 0 && dispute.given_up == own.tools_served)
    refusal_.because(nothing_left(dispute, other));
}

void HapticLoop::tell(const Dispute& dispute) {
  for (const auto& line : lines_) {
    const std::string tool = "tool " + std::to_string(line->id());
    if (dispute.given_up >> line->id() & 1u) faults_.raise(tool + ": left to another haptic_node");
    if (dispute.kept >> line->id() & 1u) faults_.raise(tool + ": another haptic_node claims it too, kept");
  }
}

// ---- the loop's thread

void HapticLoop::run() {
  const std::jthread warm([this](const std::stop_token& stop) { warm_up(setup_.model, stop); });
  statuses_ = loop_.beside(kStatusPeriod, [this, from_ns = loop_.now_ns() + kListen_ns] {
    if (loop_.now_ns() >= from_ns) publish_status();
  });
  if (local_models_) looks_ = loop_.beside(kLookPeriod, [this] { local_models_->look(); });
  grant_ = runtime::request_realtime(runtime::kHandLoopPriority, tensor_bytes(setup_.model));
  if (!grant_.warning.empty()) files::say("haptic_node: warning: " + grant_.warning);
  serve_from_ns_ = loop_.now_ns() + kListen_ns;
  while (loop_.wait() != runtime::Pace::Cause::kStopped) {
    const std::int64_t now_ns = loop_.now_ns();
    if (now_ns >= serve_from_ns_) tick(now_ns);
    loop_.finish_tick();
  }
  statuses_.reset();
  looks_.reset();
  tell_hand_overs();
  refusal_.throw_if_any();
}

void HapticLoop::require_written() {
  if (log_) log_->finish();
}

void HapticLoop::tick(std::int64_t now_ns) noexcept {
  const double elapsed_s = last_tick_ns_ == 0 ? 0 : 1e-9 * static_cast<double>(now_ns - last_tick_ns_);
  last_tick_ns_ = now_ns;
  ++ticks_;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    fresh_[i] = lines_[i]->listen(now_ns, inputs_[i]);
    if (!serves(i)) inputs_[i].engaged = inputs_[i].silent = inputs_[i].heard_again = false;  // it lets go
  }
  state_.now_ns = now_ns;
  obey();
  result_ = haptic_step(setup_.model, inputs_, state_, work_, outputs_);
  if (result_.status != physics::ContactStatus::kConverged)
    faults_.raise("contacts: the solver did not converge");
  answer(now_ns, std::min(elapsed_s, kLongestTick_s));
  tell_contacts(now_ns);
  account();
}

void HapticLoop::obey() noexcept {
  if (orders_.take_clear_fault()) {
    for (const auto& line : lines_) line->clear_fault();
    let_go_of_everything(state_);
    work_.bodies.for_each([](BodyId, Body& body) { body.restore_rest(); });
  }
  if (!orders_.take_reset()) return;
  expect_tissue_back(state_.now_ns, state_);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i]->restart();
    lines_[i]->expect_new_connection();
    inputs_[i].relocated = true;  // lets go of everything
  }
}

void HapticLoop::answer(std::int64_t now_ns, double dt_s) noexcept {
  const bool paused = orders_.paused();
  const auto again_ns = static_cast<std::int64_t>(kAnswerAgainPeriods * 1e9 / options_.rate_hz);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!serves(i)) continue;
    const msg::ToolForce& force = lines_[i]->answer(outputs_[i], now_ns, dt_s, paused);
    if (log_) note(i, force);
    accounts_[i].add(force, outputs_[i].pull_n, setup_.pull_limit_n);
    if (lines_[i]->is_told() && (fresh_[i] || now_ns - answered_ns_[i] >= again_ns)) {
      lines_[i]->sent(force_writer_->write(lines_[i]->to_send(ticks_)));
      answered_ns_[i] = now_ns;
    }
    if (outputs_[i].touching == 0) continue;
    const double newton = std::hypot(force.force.x, force.force.y, force.force.z);
    force_sum_n_ += newton;
    force_max_n_ = std::max(force_max_n_, newton);
    ++force_samples_;
  }
}

void HapticLoop::note(std::size_t line, const msg::ToolForce& force) noexcept {
  const msg::ToolPose& pose = lines_[line]->pose();
  log_->tool(line) = {pose.seq,    pose.stamp_ns, pose.position, pose.orientation,
                      force.force, force.torque,  force.state};
}

void HapticLoop::tell_contacts(std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const bool pressed = (lines_[i]->pose().buttons & msg::BUTTON_CUT) != 0 && !orders_.paused();
    news_[i] = {serves(i), pressed, frame_of(lines_[i]->pose()), lines_[i]->echo()};
  }
  teller_.tell(ticks_, now_ns, news_, outputs_, *contact_writer_);
}

void HapticLoop::account() noexcept {
  if (result_.contacts > 0) ++ticks_in_contact_;
  nodes_max_ = std::max(nodes_max_, result_.nodes);
  neighbourhood_max_ = std::max(neighbourhood_max_, result_.neighbourhood);
  const auto ticks_per_snapshot =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(options_.rate_hz / 10));
  if (ticks_ % ticks_per_snapshot != 0) return;
  Snapshot& snapshot = snapshots_.draft();
  snapshot.record = loop_.record();
  for (std::size_t i = 0; i < lines_.size(); ++i) snapshot.echoes[i] = lines_[i]->echo();
  snapshots_.post();
}

// ---- the ordinary thread

void HapticLoop::publish_status() {
  snapshots_.fetch();
  const Snapshot& snapshot = snapshots_.value();
  tell_hand_overs();
  unheard_.tell(loop_.now_ns(), lines_, faults_);
  orders_.tell(status_);
  status_.tools_served = served_.load(std::memory_order_relaxed);
  status_.echoes.assign(snapshot.echoes.begin(),
                        snapshot.echoes.begin() + static_cast<std::ptrdiff_t>(lines_.size()));
  node::fill_status(snapshot.record, faults_, status_);
  standing_.store(node::standing_of(status_.ticks, status_.rate_hz), std::memory_order_relaxed);
  node::write_as_link(*status_writer_, status_);
}

void HapticLoop::tell_hand_overs() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (const node::HandOver* last = lines_[i]->fetch_hand_over()) hand_overs_[i].take(*last);
    const std::string line = hand_overs_[i].line(lines_[i]->id(), loop_.now_ns());
    if (!line.empty()) files::say(line);
  }
}

nlohmann::json HapticLoop::report() const {
  nlohmann::json poses = nlohmann::json::array();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto& line = lines_[i];
    const PoseCounts counts = line->counts();
    poses.push_back({{"tool", line->id()},
                     {"model_changes_j", state_.tools[i].changes.given_j},
                     {"accepted", counts.accepted},
                     {"refused", counts.refused},
                     {"lost", counts.lost},
                     {"hand_overs", hand_overs_[i].report()},
                     {"energy_given_j", line->safety().tank().given_j()}});
  }
  nlohmann::json hands = nlohmann::json::array();
  for (std::size_t i = 0; i < lines_.size(); ++i)
    hands.push_back(to_json(lines_[i]->id(), accounts_[i], setup_.model.tools[i], state_.tools[i]));
  const LocalModelCounts local = local_models_ ? local_models_->counts() : LocalModelCounts{};
  const double samples = static_cast<double>(std::max<std::uint64_t>(1, force_samples_));
  const transport::EndpointStatus link = pose_reader_->status();
  return {{"dds", options_.node.dds},
          {"loop", runtime::to_json(loop_.record(), options_.rate_hz)},
          {"force_n", {{"mean", force_sum_n_ / samples}, {"max", force_max_n_}}},
          {"hands", hands},
          {"contacts",
           {{"ticks_in_contact", ticks_in_contact_},
            {"nodes_max", nodes_max_},
            {"neighbourhood_max", neighbourhood_max_}}},
          {"local_models", {{"heard", local.heard}, {"dropped", local.dropped}, {"gone", local.gone}}},
          {"poses", poses},
          {"pose_link",
           {{"deadline_missed", link.deadline_missed},
            {"liveliness_lost", link.liveliness_lost},
            {"rejected", link.rejected},
            {"incompatible_qos", link.incompatible_qos}}},
          {"realtime", {{"fifo", grant_.fifo}, {"locked", grant_.locked}}},
          {"faults", faults_.lines()}};
}

}  // namespace omentum::haptic
