#include "runtime/node_options.h"

namespace omentum::runtime {

void add_node_options(CommandLine& line, NodeOptions& options) {
  line.option("--scene", options.scene, "scene file (TOML)").required().type_name("FILE");
  line.option("--organ", options.organ, "organ file instead of the scene's first one").type_name("FILE");
  add_link_options(line, options);
  line.option("--report", options.report, "write this node's numbers here at the end (JSON)")
      .type_name("FILE")
      .writes_file();
  line.option("--log", options.log, "write every tick here (CSV)").type_name("FILE");
}

}  // namespace omentum::runtime
