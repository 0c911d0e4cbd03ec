#include "deform_node/deform_loop.h"

#include "runtime/clock.h"
#include "runtime/report.h"

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

constexpr double kStatusRateHz = 10;      // DESIGN 2: 1-10 Hz
constexpr std::size_t kFaultBytes = 160;  // string<160> of the IDL
constexpr std::size_t kHostBytes = 64;    // string<64> of the IDL

runtime::Scene read_scene(const runtime::NodeOptions& options) {
  runtime::Scene scene = runtime::load_scene(options.scene);
  if (!options.organ.empty() && !scene.organs.empty()) scene.organs.front().file = options.organ;
  return scene;
}

std::vector<OrganNumbers> numbers_of_all(const std::vector<ServedOrgan>& organs) {
  std::vector<OrganNumbers> numbers;
  for (const ServedOrgan& served : organs) numbers.push_back(numbers_of(served.organ));
  return numbers;
}

transport::BusOptions bus_options(const runtime::NodeOptions& options) {
  return {.vendor = transport::parse_vendor(options.dds),
          .domain = options.domain,
          .profile = transport::parse_profile(options.profile),
          .name = "deform_node",
          .keystore = options.keystore};
}

std::string host_name() {
  char name[kHostBytes + 1] = {};
  gethostname(name, kHostBytes);
  return name;
}

msg::Percentiles to_message(const runtime::Percentiles& p) {
  return {.p50 = p.p50, .p99 = p.p99, .p999 = p.p999, .max = p.max, .count = p.count};
}

}  // namespace

DeformLoop::DeformLoop(const DeformOptions& options, runtime::RateLoop& loop)
    : options_(options),
      scene_(read_scene(options.node)),
      organs_(load_organs(scene_, transport::parse_profile(options.node.profile))),
      book_(numbers_of_all(organs_), faults_),
      loop_(loop),
      bus_(transport::Bus::open(bus_options(options.node))) {
  if (!options.node.log.empty()) {
    log_ = std::make_unique<runtime::LoopLog>(options.node.log);
    loop_.log_to(*log_);
  }
  status_.kind = msg::NODE_DEFORM;
  status_.instance =
      (static_cast<std::uint64_t>(getpid()) << 32) ^ static_cast<std::uint64_t>(runtime::steady_now_ns());
  status_.host = host_name();
  status_.rate_hz = options_.rate_hz;

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
  const runtime::LoopRecord& record = loop_.record();
  status_.paused = paused_.load(std::memory_order_relaxed);
  status_.ticks = record.ticks;
  status_.missed = record.missed;
  status_.period_us = to_message(record.period.percentiles());
  status_.compute_us = to_message(record.compute.percentiles());
  status_.echoes.assign(book_.echoes().begin(), book_.echoes().end());
  status_.faults.clear();
  if (faults_.any())
    for (const std::string& fault : faults_.lines()) status_.faults.push_back(fault.substr(0, kFaultBytes));
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
