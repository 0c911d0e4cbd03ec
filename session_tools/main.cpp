// omentum_session: sends one command (start, pause, reset, ...) to every node of a session. Of a pause it
// says what haptic_node made of it.
#include "node_common/node_identity.h"
#include "node_common/session_orders.h"
#include "runtime/clock.h"
#include "runtime/command_line.h"
#include "transport/bus.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

using namespace omentum;

/// Discovery takes up to 2.9 s between two Fast participants (docs/topics.md).
constexpr double kDiscovery_s = 5.0;
/// Other vendors' nodes are found up to this much after the first one.
constexpr double kSettle_s = 1.2;
/// "Matched" is not "ready": a first sample may be lost across vendors, so a command is sent twice,
/// this far apart, under one order, by which nodes know the second one (node_common/session_orders.h). The
/// same time is left for delivery.
constexpr double kDelivery_s = 0.2;
/// haptic_node tells its state several times a second; a second participant's first status takes discovery
/// besides.
constexpr double kAnswer_s = 5.0;

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

double now_s() {
  return 1e-9 * static_cast<double>(runtime::steady_now_ns());
}

/// Waits until at least `nodes` readers matched, or, when that is not known (0), until no new one came for a
/// while.
int wait_for_readers(const transport::Writer<msg::SessionCommand>& writer, int nodes) {
  const double begin = now_s();
  double changed = begin;
  int matched = 0;
  while (now_s() - begin < kDiscovery_s) {
    const int now_matched = writer.status().matched;
    if (now_matched != matched) changed = now_s();
    matched = now_matched;
    if (nodes > 0 ? matched >= nodes : matched > 0 && now_s() - changed > kSettle_s) break;
    sleep_s(0.01);
  }
  return matched;
}

template <class Condition>
bool comes_true(double patience_s, Condition&& condition) {
  for (const double begin = now_s(); !condition(); sleep_s(0.01))
    if (now_s() - begin > patience_s) return false;
  return true;
}

/// What the nodes say of themselves: the commands they know of, and whether haptic_node is paused.
class Listener {
 public:
  explicit Listener(transport::Bus& bus)
      : reader_(bus.reader<msg::NodeStatus>([this](const msg::NodeStatus& status) {
          orders_.hear(status, runtime::steady_now_ns());
          if (status.kind != msg::NODE_LAUNCHER) heard_ = true;  // which hears no commands
          if (status.kind == msg::NODE_HAPTIC) said_ = status.paused ? Said::kPaused : Said::kRunning;
        })) {}

  /// A command that is later than all that the nodes know of. Where no node tells what it knows, the first
  /// one.
  msg::SessionCommand issue(std::uint32_t command) {
    comes_true(kAnswer_s, [&] { return heard_.load(); });
    return orders_.issue(command, sender_);
  }
  /// Whether haptic_node is paused, in its own words. Throws when no haptic_node speaks.
  bool paused() const {
    if (!comes_true(kAnswer_s, [&] { return said_ != Said::kNothing; }))
      throw std::runtime_error("no haptic_node answers (expected one that says whether it is paused)");
    return said_ == Said::kPaused;
  }
  /// Throws when it does not become so.
  void expect(bool paused) const {
    if (!comes_true(kAnswer_s, [&] { return this->paused() == paused; }))
      throw std::runtime_error(std::string("haptic_node ") + (paused ? "does not pause" : "stays paused"));
  }

 private:
  enum class Said { kNothing, kRunning, kPaused };
  const std::uint64_t sender_ = node::introduce(msg::NODE_LAUNCHER, 0).instance;
  node::SessionOrders orders_{runtime::steady_now_ns()};
  std::atomic<bool> heard_{false};
  std::atomic<Said> said_{Said::kNothing};
  std::unique_ptr<transport::Reader<msg::NodeStatus>> reader_;  // last: its callback uses what is above
};

void send(transport::Bus& bus, const transport::BusOptions& options, Listener& listener,
          std::uint32_t command, int nodes) {
  const auto writer = bus.writer<msg::SessionCommand>();
  const int matched = wait_for_readers(*writer, nodes);
  if (matched == 0)
    throw std::runtime_error("no node found in domain " + std::to_string(options.domain) +
                             " (expected a running session)");
  const msg::SessionCommand message = listener.issue(command);
  for (int copy = 0; copy < 2; ++copy) {
    if (!writer->write(message)) throw std::runtime_error("the command could not be written");
    sleep_s(kDelivery_s);
  }
}

/// Returns when haptic_node says that it obeyed, and says so.
void send_pause(transport::Bus& bus, const transport::BusOptions& options, Listener& listener, bool paused,
                int nodes) {
  send(bus, options, listener, paused ? msg::COMMAND_PAUSE : msg::COMMAND_START, nodes);
  listener.expect(paused);
  std::puts(paused ? "paused" : "goes on");
}

constexpr std::uint32_t kTogglePause =
    ~std::uint32_t{0};  // not on the wire: pause or start, whichever it is not

void run(const transport::BusOptions& options, std::uint32_t command, int nodes) {
  const auto bus = transport::Bus::open(options);
  Listener listener(*bus);
  if (command == kTogglePause || command == msg::COMMAND_PAUSE || command == msg::COMMAND_START) {
    const bool pause = command == kTogglePause ? !listener.paused() : command == msg::COMMAND_PAUSE;
    return send_pause(*bus, options, listener, pause, nodes);
  }
  send(*bus, options, listener, command, nodes);
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, std::uint32_t> commands{{"start", msg::COMMAND_START},
                                                      {"pause", msg::COMMAND_PAUSE},
                                                      {"toggle-pause", kTogglePause},
                                                      {"reset", msg::COMMAND_RESET},
                                                      {"clear-fault", msg::COMMAND_CLEAR_FAULT},
                                                      {"record", msg::COMMAND_RECORD}};
  runtime::CommandLine line("omentum_session", "Sends one command to every node of a running session.");
  std::vector<std::string> names;
  for (const auto& [name, number] : commands) names.push_back(name);
  std::string command;
  runtime::LinkOptions link;
  int nodes = 0;
  line.option("command", command,
              "start, pause, toggle-pause, reset, clear-fault or record (begins a video, or ends it)")
      .required()
      .one_of(names);
  runtime::add_link_options(line, link);
  line.option("--nodes", nodes, "send as soon as so many nodes listen (0: when no further one is found)")
      .between(0, 64)
      .show_default();

  return line.run(argc, argv,
                  [&] { run(node::bus_options(link, "omentum_session"), commands.at(command), nodes); });
}
