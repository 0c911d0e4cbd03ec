// haptic_node: the hand's loop. ToolPose in, ToolForce and Contact out.
#include "haptic_node/haptic_loop.h"
#include "node_common/node_identity.h"
#include "runtime/niceness.h"
#include "runtime/rate_loop.h"
#include "runtime/report.h"
#include "runtime/signals.h"

#include <nlohmann/json.hpp>

int main(int argc, char** argv) {
  using namespace omentum;
  runtime::CommandLine line(
      "haptic_node", "Feels the scene's organs with the tools' points and answers each pose with a force.");
  haptic::HapticOptions options;
  runtime::add_node_options(line, options.node);
  line.option("--rate-hz", options.rate_hz, "rate without a device; a miss is counted against its period")
      .between(50.0, 10000.0)
      .show_default();

  return line.run(argc, argv, [&] {
    runtime::take_nice(runtime::kHandNice);
    runtime::RateLoop pace(options.rate_hz);
    runtime::StopSignal signal([&] { pace.stop(); });
    const auto open_bus = [&] { return node::open_bus(options.node, "haptic_node"); };
    haptic::HapticLoop loop(options, open_bus, pace);
    loop.run();
    if (!options.node.report.empty()) runtime::write_report(loop.report(), options.node.report);
    loop.require_written();
  });
}
