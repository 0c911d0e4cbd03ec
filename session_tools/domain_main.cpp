// omentum_domain: claims a DDS domain on the network. Listens whether a session is there; then says "free"
// and holds the domain until it is ended, or says "used by WHOM" and ends.
#include "node_common/node_identity.h"
#include "runtime/command_line.h"
#include "runtime/rate_loop.h"
#include "runtime/signals.h"
#include "session_tools/domain_claim.h"
#include "transport/bus.h"

#include <cstdio>
#include <mutex>

namespace {

using namespace omentum;

/// How often a claim is told. A node's status is durable: whoever finds it hears it at once.
constexpr double kRate_hz = 2;
/// 2.5 s of listening: Cyclone finds its like within 0.1 s and a Fast participant within about one.
constexpr int kListeningTicks = 5;

/// The first one that was found with a better claim.
class Rival {
 public:
  void meet(const session::DomainClaim& own, const msg::NodeStatus& other) {
    auto better = session::better_claim(own, other);
    const std::lock_guard lock(mutex_);
    if (!name_) name_ = std::move(better);
  }
  std::optional<std::string> name() const {
    const std::lock_guard lock(mutex_);
    return name_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<std::string> name_;
};

void say(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);  // whoever started this waits for it
}

void run(const transport::BusOptions& options) {
  const msg::NodeStatus self = node::introduce(msg::NODE_LAUNCHER, kRate_hz);
  const session::DomainClaim listening{self.instance, self.host, false};
  session::DomainClaim claim = listening;
  runtime::RateLoop loop(kRate_hz);
  const runtime::StopSignal stop([&loop] { loop.stop(); });
  Rival rival;
  const auto bus = transport::Bus::open(options);
  const auto writer = bus->writer<msg::NodeStatus>();
  const auto reader =
      bus->reader<msg::NodeStatus>([&](const msg::NodeStatus& other) { rival.meet(listening, other); });
  writer->write(session::status_of(claim));
  for (int tick = 0; loop.wait() != runtime::RateLoop::Cause::kStopped; ++tick) {
    if (!claim.held) {
      if (const auto name = rival.name()) return say("used by " + *name);
      claim.held = tick >= kListeningTicks;
      if (claim.held) say("free");
    }
    writer->write(session::status_of(claim));
    loop.finish_tick();
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("omentum_domain", "Claims a DDS domain on the network for a session.");
  runtime::LinkOptions link;
  link.dds = "cyclone";
  link.profile = "lan";
  runtime::add_link_options(line, link);
  return line.run(argc, argv, [&] { run(node::bus_options(link, "omentum_domain")); });
}
