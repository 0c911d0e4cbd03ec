#include "runtime/link_options.h"

namespace omentum::runtime {

void add_link_options(CommandLine& line, LinkOptions& options) {
  line.needs(kRoomForDds);
  line.option("--dds", options.dds, "DDS vendor: fast or cyclone").one_of({"fast", "cyclone"}).show_default();
  line.option("--domain", options.domain, "DDS domain of the session").between(0, 230).show_default();
  line.option("--profile", options.profile, "loopback (one machine) or lan")
      .one_of({"loopback", "lan"})
      .show_default();
  line.option("--secure", options.keystore, "DDS Security key store").type_name("KEYSTORE");
}

}  // namespace omentum::runtime
