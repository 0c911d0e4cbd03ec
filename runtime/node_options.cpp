#include "runtime/node_options.h"

namespace omentum::runtime {

void add_node_options(CommandLine& line, NodeOptions& options) {
  line.needs(kRoomForDds);
  line.option("--scene", options.scene, "scene file (TOML)").required().type_name("FILE");
  line.option("--organ", options.organ, "organ file instead of the scene's first one").type_name("FILE");
  line.option("--dds", options.dds, "DDS vendor: fast or cyclone").one_of({"fast", "cyclone"}).show_default();
  line.option("--domain", options.domain, "DDS domain").between(0, 230).show_default();
  line.option("--profile", options.profile, "loopback (one machine) or lan")
      .one_of({"loopback", "lan"})
      .show_default();
  line.option("--secure", options.keystore, "DDS Security key store").type_name("KEYSTORE");
  line.option("--report", options.report, "write this node's numbers here at the end (JSON)")
      .type_name("FILE")
      .writes_file();
  line.option("--log", options.log, "write every tick here (CSV)").type_name("FILE");
}

}  // namespace omentum::runtime
