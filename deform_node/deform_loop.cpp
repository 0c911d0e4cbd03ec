#include "deform_node/deform_loop.h"

#include "node_common/node_identity.h"
#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace omentum::deform {

namespace {

constexpr double kStatusRateHz = 10;  // docs/topics.md: 1-10 Hz

// How long to listen for a scene that is served already, ns: haptic_node listens as long, so that this delays
// no force, and the first picture by a second.
constexpr std::int64_t kListen_ns = 1'000'000'000;
constexpr auto kSettled_ns = static_cast<std::int64_t>(1e9 * node::kSettled_s);

// whoever writes statuses must not fill a terminal
void say_once(bool& said, const char* what) {
  if (!std::exchange(said, true)) std::cerr << "deform_node: " << what << std::endl;
}

std::vector<OrganNumbers> numbers_of_all(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganNumbers> numbers;
  numbers.reserve(organs.size());
  for (const ServedOrgan& served : organs) numbers.push_back(numbers_of(served.organ));
  return numbers;
}

}  // namespace

DeformLoop::DeformLoop(const DeformOptions& options, const transport::OpenBus& open_bus, runtime::Pace& loop)
    : options_(options),
      scene_(node::load_scene(options.node)),
      organs_(load_organs(scene_, transport::parse_profile(options.node.profile))),
      book_(numbers_of_all(organs_), bounds_of(scene_), faults_),
      loop_(loop),
      start_ns_(loop_.now_ns()),
      loaded_(node::loaded_scene(scene_, describe(organs_))),
      orders_(start_ns_),
      refusal_(loop),
      status_(node::introduce(msg::NODE_DEFORM, options.rate_hz)),
      standby_(status_.instance),
      bus_(open_bus()) {
  if (!options.node.log.empty()) {
    log_ = std::make_unique<runtime::LoopLog>(options.node.log);
    loop_.log_to(*log_);
  }
  scene_writer_ = bus_->writer<msg::SceneInfo>();
  topology_writer_ = bus_->writer<msg::Topology>();
  state_writer_ = bus_->writer<msg::OrganState>();
  status_writer_ = bus_->writer<msg::NodeStatus>();
  contact_reader_ = bus_->reader<msg::Contact>(
      [this](const msg::Contact& contact) { book_.take(contact, loop_.now_ns()); });
  command_reader_ = bus_->reader<msg::SessionCommand>(
      [this](const msg::SessionCommand& command) { orders_.hear(command, loop_.now_ns()); });
  scene_reader_ = bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& other) { hear(other); });
  node_reader_ = bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& other) {
    const std::int64_t now_ns = loop_.now_ns();
    orders_.hear(other, now_ns);
    standby_.hear(other, now_ns);
  });
}

void DeformLoop::run() {
  while (loop_.wait() != runtime::Pace::Cause::kStopped) {
    if (loop_.now_ns() - start_ns_ >= kListen_ns) serve_or_stand_by();
    loop_.finish_tick();
  }
  refusal_.throw_if_any();
}

void DeformLoop::require_written() {
  if (log_) log_->finish();
}

void DeformLoop::serve_or_stand_by() {
  const bool other_serves = standby_.other_serves(loop_.now_ns());
  if (other_serves && role_ != Role::kStandingBy) stand_by();
  if (!other_serves && role_ != Role::kServing) take_up();
  if (role_ == Role::kServing) tick();
}

void DeformLoop::take_up() {
  if (role_ == Role::kStandingBy) say_once(told_serving_, "the other one fell silent, this one serves");
  role_ = Role::kServing;
  if (std::exchange(introduced_, true)) return;
  scene_writer_->write(node::to_message(loaded_, scene_.name));
  for (std::size_t i = 0; i < organs_.size(); ++i)
    topology_writer_->write(uncut_topology(static_cast<std::uint32_t>(i), organs_[i].organ));
}

void DeformLoop::stand_by() {
  say_once(told_standing_by_, "another deform_node serves this scene, this one stands by");
  if (role_ == Role::kServing) faults_.raise("scene: another deform_node serves it as well, left to it");
  role_ = Role::kStandingBy;
  standby_.stepped_back();
}

void DeformLoop::hear(const msg::SceneInfo& other) {
  auto why = node::contradicts(loaded_, other);
  if (!why) return;
  if (loop_.now_ns() - start_ns_ > kSettled_ns) {
    faults_.raise(node::kForeignScene);
  } else {
    refusal_.because(*std::move(why));
  }
}

void DeformLoop::tick() noexcept {
  obey();
  const std::int64_t now_ns = loop_.now_ns();
  book_.advance(now_ns);
  if (!orders_.paused()) {
    for (std::size_t i = 0; i < organs_.size(); ++i)
      organs_[i].model->step(book_.loads(static_cast<std::uint32_t>(i)), 1 / options_.rate_hz);
    ++steps_;
  }
  publish(now_ns);
  ++ticks_;
}

void DeformLoop::obey() noexcept {
  if (!orders_.take_reset()) return;
  book_.forget(loop_.now_ns());
  for (ServedOrgan& served : organs_) served.model->reset();
}

void DeformLoop::publish(std::int64_t now_ns) noexcept {
  ++states_;
  for (ServedOrgan& served : organs_) {
    fill_blocks(served, states_, now_ns, book_.echoes());
    for (const msg::OrganState& block : served.blocks) state_writer_->write(block);
  }
  const auto ticks_per_status = std::max<std::uint64_t>(1, std::lround(options_.rate_hz / kStatusRateHz));
  if (ticks_ % ticks_per_status == 0) publish_status();
}

void DeformLoop::publish_status() noexcept {
  orders_.tell(status_);
  status_.echoes.assign(book_.echoes().begin(), book_.echoes().end());
  node::fill_status(loop_.record(), faults_, status_);
  standby_.serving(status_);
  status_writer_->write(status_);
}

nlohmann::json DeformLoop::report() const {
  return {{"dds", options_.node.dds}, {"loop", runtime::to_json(loop_.record(), options_.rate_hz)},
          {"states", states_},        {"steps", steps_},
          {"removed_tetrahedra", 0},  {"faults", faults_.lines()}};
}

}  // namespace omentum::deform
