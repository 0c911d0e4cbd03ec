// A node that does nothing but wait for its end: what CommandLine and StopSignal make of it is under test.
#include "runtime/node_options.h"
#include "runtime/rate_loop.h"
#include "runtime/signals.h"
#include "scene/scene.h"

#include <iostream>

int main(int argc, char** argv) {
  omentum::runtime::CommandLine line("node_main_example", "waits for a signal");
  omentum::runtime::NodeOptions options;
  omentum::runtime::add_node_options(line, options);
  return line.run(argc, argv, [&] {
    omentum::scene::load_scene(options.scene);
    omentum::runtime::RateLoop loop(1000);
    omentum::runtime::StopSignal stop_signal([&] { loop.stop(); });
    std::cout << "ready" << std::endl;
    while (loop.wait() != omentum::runtime::RateLoop::Cause::kStopped) loop.finish_tick();
    std::cout << "stopped" << std::endl;
  });
}
