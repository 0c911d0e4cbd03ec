// The command line that haptic_node, deform_node, render_node and virtual_device share (DESIGN 5).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace omentum::runtime {

struct NodeOptions {
  std::filesystem::path scene;       // --scene
  std::filesystem::path organ;       // --organ: overrides the scene's organ file
  std::string dds = "fast";          // --dds fast|cyclone
  int domain = 0;                    // --domain 0..230
  std::string profile = "loopback";  // --profile loopback|lan
  std::string keystore;              // --secure KEYSTORE
  std::filesystem::path report;      // --report FILE
  std::filesystem::path log;         // --log FILE: loop samples as CSV
};

/// Adds the shared options to `app`.
void add_node_options(CLI::App& app, NodeOptions& options);

/// Parses, calls `run`, and turns what happens into an exit code: 0 after run() returns, and for --help;
/// 2 with one line "NAME: what and where" on stderr for a wrong argument or any std::exception.
int node_main(CLI::App& app, int argc, char** argv, const std::function<void()>& run);

}  // namespace omentum::runtime
