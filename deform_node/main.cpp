// deform_node: moves the organs. Contact in, OrganState out.
#include "deform_node/deform_loop.h"
#include "runtime/report.h"
#include "runtime/signals.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

int main(int argc, char** argv) {
  using namespace omentum;
  CLI::App app("Deforms the scene's organs under the tools' contacts and publishes their surfaces.",
               "deform_node");
  deform::DeformOptions options;
  runtime::add_node_options(app, options.node);
  app.add_option("--rate-hz", options.rate_hz, "states per second")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();

  return runtime::node_main(app, argc, argv, [&] {
    runtime::RateLoop pace(options.rate_hz);
    runtime::StopSignal signal([&] { pace.stop(); });
    deform::DeformLoop loop(options, pace);
    loop.run();
    if (!options.node.report.empty()) runtime::write_report(loop.report(), options.node.report);
  });
}
