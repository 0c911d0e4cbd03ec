// deform_node: moves the organs. Contact in, OrganState out.
#include "deform_node/deform_loop.h"
#include "node_common/node_identity.h"
#include "physics/blas_memory.h"
#include "runtime/niceness.h"
#include "runtime/rate_loop.h"
#include "runtime/report.h"
#include "runtime/signals.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  using namespace omentum;
  if (!physics::keep_blas_buffers(1)) {  // organs that move factorize a matrix
    std::cerr << "deform_node: " << physics::kNoBlasMemory << std::endl;
    std::_Exit(2);
  }
  runtime::CommandLine line(
      "deform_node", "Deforms the scene's organs under the tools' contacts and publishes their surfaces.");
  deform::DeformOptions options;
  runtime::add_node_options(line, options.node);
  line.option("--journal", options.journal, "keep cuts here, and begin with those that are there (JSON)")
      .type_name("FILE")
      .writes_file();
  line.option("--rate-hz", options.rate_hz, "states per second").between(1.0, 1000.0).show_default();

  return line.run(argc, argv, [&] {
    runtime::take_nice(runtime::kOrganNice);  // before the bus: its threads carry what the hand waits for
    runtime::RateLoop pace(options.rate_hz);
    runtime::StopSignal signal([&] { pace.stop(); });
    const auto open_bus = [&] { return node::open_bus(options.node, "deform_node"); };
    deform::DeformLoop loop(options, open_bus, pace);
    loop.run();
    if (!options.node.report.empty()) runtime::write_report(loop.report(), options.node.report);
    loop.require_written();
  });
}
