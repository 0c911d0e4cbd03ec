// A simulated hand, a recorded one or a person's mouse on the wire: the example to copy for a real device
// (docs/devices.md). Replace make_devices() by your own implementation of device_bridge/device.h.
#include "device_bridge/device_bridge.h"
#include "device_bridge/frames/frame_file.h"
#include "device_bridge/mouse_hand.h"
#include "device_bridge/trace_player.h"
#include "device_bridge/virtual_hand.h"
#include "node_common/node_identity.h"
#include "runtime/niceness.h"
#include "runtime/rate_loop.h"
#include "runtime/report.h"
#include "runtime/signals.h"

#include <algorithm>
#include <stdexcept>

namespace {

using namespace omentum;
using Devices = std::vector<std::unique_ptr<device::Device>>;

struct Options {
  device::BridgeOptions bridge;
  std::filesystem::path trace, frames;
  bool mouse = false;
};

const scene::ToolSpec& tool_of(const scene::Scene& scene, std::uint32_t id, const std::string& who) {
  const auto tool =
      std::find_if(scene.tools.begin(), scene.tools.end(), [id](const auto& t) { return t.id == id; });
  if (tool == scene.tools.end()) {
    throw std::runtime_error(who + ": found tool " + std::to_string(id) + ", expected one of " +
                             scene.file.string());
  }
  return *tool;
}

[[noreturn]] void refuse_enable_button(const Options& options, std::uint32_t tool, const std::string& who) {
  throw std::runtime_error(options.frames.string() + ": devices: found enable_button of tool " +
                           std::to_string(tool) + ", which " + who + " never presses; expected a recorded " +
                           "hand that does (--trace, column buttons), or a device of your own");
}

// Without this it would play, and its tool never be held.
void require_enabled(const Options& options, std::uint32_t tool, const device::Trace* trace) {
  const auto mapping = options.bridge.mappings.find(tool);
  if (mapping == options.bridge.mappings.end() || !mapping->second.enable_button) return;
  const std::uint32_t bit = 1U << *mapping->second.enable_button;
  if (!trace) refuse_enable_button(options, tool, "a simulated hand");
  if (std::ranges::none_of(*trace, [&](const device::TracePoint& p) { return (p.buttons & bit) != 0; }))
    refuse_enable_button(options, tool, options.trace.string());
}

Devices make_devices(const Options& options, const scene::Scene& scene, const device::RayInbox& rays) {
  Devices devices;
  if (options.mouse && !options.trace.empty()) {
    throw std::runtime_error("--mouse: found --trace beside it, expected one of them");
  }
  if (options.mouse && !options.frames.empty()) {
    throw std::runtime_error(
        "--mouse: found --frames beside it, expected one of them: the tip is where the pointer is, and only "
        "motion counts");
  }
  if (!options.trace.empty()) {
    for (auto& [id, trace] : device::read_trace(options.trace)) {
      tool_of(scene, id, options.trace.string());
      require_enabled(options, id, &trace);
      devices.push_back(std::make_unique<device::TracePlayer>(id, trace, options.bridge.rate_hz));
    }
    return devices;
  }
  for (const scene::HandSpec& hand : scene.hands) {
    const scene::ToolSpec& tool = tool_of(scene, hand.tool, scene.file.string());
    const double rate_hz = options.bridge.rate_hz;
    require_enabled(options, hand.tool, nullptr);
    if (options.mouse) {  // the first one waits for it
      devices.push_back(std::make_unique<device::MouseHand>(hand, tool, rate_hz, rays, devices.empty()));
    } else {
      const auto& mappings = options.bridge.mappings;
      const auto found = mappings.find(hand.tool);
      const auto mapping = found == mappings.end() ? std::nullopt : std::optional(found->second);
      devices.push_back(std::make_unique<device::VirtualHand>(hand, tool, rate_hz, mapping));
    }
  }
  if (devices.empty()) {
    throw std::runtime_error(scene.file.string() +
                             ": hands: found none, expected at least one [[hands]], or --trace FILE");
  }
  return devices;
}

void run(Options& options) {
  const scene::Scene scene = node::load_scene(options.bridge.node);
  options.bridge.scene = node::loaded_scene(scene, {});
  if (!options.frames.empty()) options.bridge.mappings = device::read_frames(options.frames, scene.tools);
  runtime::take_nice(runtime::kHandNice);
  runtime::RateLoop loop(options.bridge.rate_hz);
  runtime::StopSignal stop_signal([&loop] { loop.stop(); });
  const auto open_bus = [&] { return node::open_bus(options.bridge.node, "virtual_device"); };
  device::RayInbox rays;
  if (options.mouse) options.bridge.rays = &rays;
  device::DeviceBridge bridge(options.bridge, make_devices(options, scene, rays), open_bus, loop);
  bridge.run();
  if (!options.bridge.node.report.empty()) runtime::write_report(bridge.report(), options.bridge.node.report);
  bridge.require_written();
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "virtual_device",
      "A simulated hand that presses an organ of the scene and feels its force, a recorded hand, or a "
      "person's mouse in the window");
  Options options;
  runtime::add_node_options(line, options.bridge.node);
  line.option("--trace", options.trace, "play this recorded hand instead of the scene's script")
      .type_name("FILE");
  line.flag("--mouse", options.mouse,
            "the first hand, and any that key Tab picks, follows the pointer in render_node's window");
  line.option("--frames", options.frames,
              "how each device stands in the scene: axes, scale, clutch, handle (docs/devices.md)")
      .type_name("FILE");
  line.option("--record", options.bridge.record, "record the poses as a trace").type_name("FILE");
  line.option("--rate-hz", options.bridge.rate_hz, "poses per second")
      .between(device::kSlowestRate_hz, 10000.0)
      .show_default();
  line.option("--seconds", options.bridge.seconds, "end after this time; 0: run until stopped")
      .between(0.0, 1e6)
      .show_default();
  return line.run(argc, argv, [&] { run(options); });
}
