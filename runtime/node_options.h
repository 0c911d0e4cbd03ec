// The command line that haptic_node, deform_node, render_node and virtual_device share.
#pragma once

#include "runtime/link_options.h"

#include <filesystem>

namespace omentum::runtime {

struct NodeOptions : LinkOptions {
  std::filesystem::path scene;   // --scene
  std::filesystem::path organ;   // --organ: organ file instead of the scene's first one
  std::filesystem::path report;  // --report FILE
  std::filesystem::path log;     // --log FILE: loop samples as CSV
};

/// Adds the shared options, and the room that a node needs, to `line`.
void add_node_options(CommandLine& line, NodeOptions& options);

}  // namespace omentum::runtime
