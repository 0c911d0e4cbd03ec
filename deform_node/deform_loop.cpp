#include "deform_node/deform_loop.h"

#include "node/node_identity.h"
#include "runtime/clock.h"
#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

constexpr double kStatusRateHz = 10;  // DESIGN 2: 1-10 Hz

std::vector<OrganNumbers> numbers_of_all(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganNumbers> numbers;
  numbers.reserve(organs.size());
  for (const ServedOrgan& served : organs) numbers.push_back(numbers_of(served.organ));
  return numbers;
}

}  // namespace

DeformLoop::DeformLoop(const DeformOptions& options, runtime::RateLoop& loop)
    : options_(options),
      scene_(node::load_scene(options.node)),
      organs_(load_organs(scene_, transport::parse_profile(options.node.profile))),
      book_(numbers_of_all(organs_), faults_),
      loop_(loop),
      status_(node::introduce(msg::NODE_DEFORM, options.rate_hz)),
      bus_(transport::Bus::open(node::bus_options(options.node, "deform_node"))) {
  if (!options.node.log.empty()) {
    log_ = std::make_unique<runtime::LoopLog>(options.node.log);
    loop_.log_to(*log_);
  }
  scene_writer_ = bus_->writer<msg::SceneInfo>();
  topology_writer_ = bus_->writer<msg::Topology>();
  state_writer_ = bus_->writer<msg::OrganState>();
  status_writer_ = bus_->writer<msg::NodeStatus>();
  scene_writer_->write(describe_scene(scene_, organs_));
  for (std::size_t i = 0; i < organs_.size(); ++i)
    topology_writer_->write(uncut_topology(static_cast<std::uint32_t>(i), organs_[i].organ));

  contact_reader_ = bus_->reader<msg::Contact>(
      [this](const msg::Contact& contact) { book_.take(contact, runtime::steady_now_ns()); });
  command_reader_ = bus_->reader<msg::SessionCommand>([this](const msg::SessionCommand& c) { command(c); });
}

void DeformLoop::run() {
  while (loop_.wait() != runtime::RateLoop::Cause::kStopped) {
    tick();
    loop_.finish_tick();
  }
}

void DeformLoop::tick() noexcept {
  obey();
  const std::int64_t now_ns = runtime::steady_now_ns();
  book_.advance(now_ns);
  if (!paused_.load(std::memory_order_relaxed)) {
    for (std::size_t i = 0; i < organs_.size(); ++i)
      organs_[i].model->step(book_.loads(static_cast<std::uint32_t>(i)), 1 / options_.rate_hz);
    ++steps_;
  }
  publish(now_ns);
  ++ticks_;
}

void DeformLoop::obey() noexcept {
  if (!reset_.exchange(false, std::memory_order_acquire)) return;
  book_.forget(runtime::steady_now_ns());
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
  status_.paused = paused_.load(std::memory_order_relaxed);
  status_.echoes.assign(book_.echoes().begin(), book_.echoes().end());
  node::fill_status(loop_.record(), faults_, status_);
  status_writer_->write(status_);
}

void DeformLoop::command(const msg::SessionCommand& command) noexcept {
  if (command.command == msg::COMMAND_START) paused_.store(false, std::memory_order_relaxed);
  if (command.command == msg::COMMAND_PAUSE) paused_.store(true, std::memory_order_relaxed);
  if (command.command == msg::COMMAND_RESET) reset_.store(true, std::memory_order_release);
}

nlohmann::json DeformLoop::report() const {
  return {{"dds", options_.node.dds}, {"loop", runtime::to_json(loop_.record(), options_.rate_hz)},
          {"states", states_},        {"steps", steps_},
          {"removed_tetrahedra", 0},  {"faults", faults_.lines()}};
}

}  // namespace omentum::deform
