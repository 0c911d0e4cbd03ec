#include "node_common/node_identity.h"

#include "files/console.h"
#include "node_common/loaded_scene.h"

#include <unistd.h>

#include <chrono>

namespace omentum::node {

msg::Percentiles to_message(const runtime::Percentiles& p) {
  return {.p50 = p.p50, .p99 = p.p99, .p999 = p.p999, .max = p.max, .count = p.count};
}

scene::Scene load_scene(const runtime::NodeOptions& options) {
  scene::Scene scene = scene::load_scene(options.scene);
  require_tellable(scene);
  if (!options.organ.empty() && !scene.organs.empty()) scene.organs.front().file = options.organ;
  return scene;
}

transport::BusOptions bus_options(const runtime::LinkOptions& options, std::string name) {
  return {.vendor = transport::parse_vendor(options.dds),
          .domain = options.domain,
          .profile = transport::parse_profile(options.profile),
          .name = std::move(name),
          .keystore = options.keystore};
}

std::unique_ptr<transport::Bus> open_bus(const runtime::LinkOptions& options, const std::string& name) {
  auto bus = transport::Bus::open(bus_options(options, name));
  const std::string warning = bus->warning();
  if (!warning.empty()) files::say(name + ": warning: " + warning);
  return bus;
}

msg::NodeStatus introduce(std::uint32_t kind, double rate_hz) {
  msg::NodeStatus status;
  status.kind = kind;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  status.instance = static_cast<std::uint64_t>(std::chrono::nanoseconds(since_epoch).count());
  char host[msg::MAX_NAME + 1] = {};
  gethostname(host, msg::MAX_NAME);
  status.host = host;
  status.rate_hz = rate_hz;
  return status;
}

void fill_status(const runtime::LoopRecord& record, const runtime::FaultList& faults,
                 msg::NodeStatus& status) {
  status.ticks = record.ticks;
  status.missed = record.missed;
  status.period_us = to_message(record.period.percentiles());
  status.compute_us = to_message(record.compute.percentiles());
  fill_faults(faults, status);
}

void fill_faults(const runtime::FaultList& faults, msg::NodeStatus& status) {
  status.faults.clear();
  if (!faults.any()) return;
  for (const std::string& fault : faults.lines()) status.faults.push_back(fault.substr(0, msg::MAX_LINE));
}

}  // namespace omentum::node
