// People who look on: participants that read forces and organ states, and nothing else.
//
//   onlookers --count 7 --dds fast --domain 7 --profile lan
//
// Prints "ready", then listens until its standard input ends, and prints a line of JSON: what all of them
// heard.
#include "runtime/command_line.h"
#include "transport/bus.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <memory>
#include <vector>

namespace {

using namespace omentum;

struct Options {
  int count = 1, domain = 0;
  std::string dds = "fast", profile = "lan";
};

/// A participant of its own, as a process would be. Its callbacks run on the vendor's threads.
class Onlooker {
 public:
  explicit Onlooker(const Options& options)
      : bus_(transport::Bus::open({.vendor = transport::parse_vendor(options.dds),
                                   .domain = options.domain,
                                   .profile = transport::parse_profile(options.profile),
                                   .name = "onlooker"})),
        forces_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce&) { ++heard_forces; })),
        states_(bus_->reader<msg::OrganState>([this](const msg::OrganState&) { ++heard_states; })) {}

  std::atomic<std::uint64_t> heard_forces{0}, heard_states{0};

 private:
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Reader<msg::OrganState>> states_;
};

void look_on(const Options& options) {
  std::vector<std::unique_ptr<Onlooker>> all;
  for (int i = 0; i < options.count; ++i) all.push_back(std::make_unique<Onlooker>(options));
  std::puts("ready");
  std::fflush(stdout);
  for (char byte; read(STDIN_FILENO, &byte, 1) > 0;) continue;
  std::uint64_t forces = 0, states = 0, deaf = 0;
  for (const auto& one : all) {
    forces += one->heard_forces, states += one->heard_states;
    deaf += one->heard_forces == 0;
  }
  std::printf("{\"forces\": %ju, \"states\": %ju, \"deaf\": %ju}\n", forces, states, deaf);
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("onlookers", "Participants that read forces and organ states.");
  Options options;
  line.option("--count", options.count, "participants").between(1, 100).show_default();
  line.option("--dds", options.dds, "fast or cyclone").show_default();
  line.option("--domain", options.domain, "DDS domain").between(0, 230).show_default();
  line.option("--profile", options.profile, "loopback or lan").show_default();
  return line.run(argc, argv, [&] {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind by a test that was killed
    look_on(options);
  });
}
