// The part of a command line that says where a program joins a session: all that speak on the topics share
// it.
#pragma once

#include "runtime/command_line.h"

#include <string>

namespace omentum::runtime {

struct LinkOptions {
  std::string dds = "fast";          // --dds fast|cyclone
  int domain = 0;                    // --domain 0..230
  std::string profile = "loopback";  // --profile loopback|lan
  std::string keystore;              // --secure KEYSTORE
};

/// Adds these options, with what is set in `options` as their defaults, and the room that DDS needs, to
/// `line`.
void add_link_options(CommandLine& line, LinkOptions& options);

}  // namespace omentum::runtime
