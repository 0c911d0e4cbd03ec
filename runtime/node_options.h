// The command line that haptic_node, deform_node, render_node and virtual_device share.
#pragma once

#include "runtime/command_line.h"

#include <filesystem>
#include <string>

namespace omentum::runtime {

struct NodeOptions {
  std::filesystem::path scene;       // --scene
  std::filesystem::path organ;       // --organ: organ file instead of the scene's first one
  std::string dds = "fast";          // --dds fast|cyclone
  int domain = 0;                    // --domain 0..230
  std::string profile = "loopback";  // --profile loopback|lan
  std::string keystore;              // --secure KEYSTORE
  std::filesystem::path report;      // --report FILE
  std::filesystem::path log;         // --log FILE: loop samples as CSV
};

/// Adds the shared options, and the room that a node needs, to `line`.
void add_node_options(CommandLine& line, NodeOptions& options);

}  // namespace omentum::runtime
