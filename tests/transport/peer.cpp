// The other process of the contract tests: sends what the first argument names until its standard input ends,
// and prints a line once its writers exist.
//   transport_peer <known|durable|organ|blocks|contacts|poses|answers|hand> <fast|cyclone> <domain>
//   <loopback|lan>
//                  [KEYSTORE ROLE]
#include "tests/transport/fill.h"
#include "transport/topics.h"

#include <poll.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <thread>
#include <tuple>

namespace {

using namespace omentum;
using transport::Bus;
using transport::Writer;

bool input_ended() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

void say_ready() {
  std::cout << "ready" << std::endl;
}

template <class Send>
void until_input_ends(std::chrono::microseconds period, Send&& send) {
  say_ready();
  while (!input_ended()) {
    send();
    std::this_thread::sleep_for(period);
  }
}

template <class M>
struct KnownSender {
  explicit KnownSender(Bus& bus) : writer(bus.writer<M>()), messages(test::known_messages<M>()) {}
  void send(std::size_t turn) { writer->write(messages[turn % messages.size()]); }

  std::unique_ptr<Writer<M>> writer;
  std::vector<M> messages;
};

template <class... M>
void send_known(msg::TopicList<M...>, Bus& bus) {
  std::tuple<KnownSender<M>...> senders{KnownSender<M>(bus)...};
  std::size_t turn = 0;
  until_input_ends(std::chrono::milliseconds(15), [&] {
    std::apply([&](auto&... sender) { (sender.send(turn), ...); }, senders);
    ++turn;
  });
}

// each durable topic's known messages, once, before any reader exists
template <class... M>
void send_durable(msg::TopicList<M...>, Bus& bus) {
  std::tuple<KnownSender<M>...> senders{KnownSender<M>(bus)...};
  for (std::size_t turn = 0; turn < std::size(test::kAllLengths); ++turn)
    std::apply([&](auto&... sender) { (sender.send(turn), ...); }, senders);
  until_input_ends(std::chrono::milliseconds(20), [] {});
}

void send_organ(Bus& bus) {
  const auto writer = bus.writer<msg::OrganState>();
  const msg::OrganState state = test::large_organ_state();
  until_input_ends(std::chrono::milliseconds(50), [&] { writer->write(state); });
}

// one block a millisecond, so that no receiver's buffer is filled by a state at once
void send_blocks(Bus& bus) {
  const auto writer = bus.writer<msg::OrganState>();
  const auto blocks = test::organ_state_in_blocks(transport::organ_block_floats(transport::Profile::kLan));
  std::size_t turn = 0;
  until_input_ends(std::chrono::milliseconds(1), [&] { writer->write(blocks[turn++ % blocks.size()]); });
}

void send_contacts(Bus& bus) {
  KnownSender<msg::Contact> contacts(bus);
  std::size_t turn = 0;
  until_input_ends(std::chrono::milliseconds(4), [&] { contacts.send(turn++); });
}

// two tools at 1 kHz, numbered from 1; every hundredth number is left out
void send_poses(Bus& bus) {
  const auto writer = bus.writer<msg::ToolPose>();
  msg::ToolPose pose;
  until_input_ends(std::chrono::milliseconds(1), [&] {
    ++pose.seq;
    if (pose.seq % 100 == 0) return;
    for (pose.tool = 0; pose.tool < 2; ++pose.tool) {
      pose.position.x = pose.tool + 1;
      writer->write(pose);
    }
  });
}

// answers each pose, and tells its status twice a second
void send_answers(Bus& bus) {
  const auto forces = bus.writer<msg::ToolForce>();
  const auto statuses = bus.writer<msg::NodeStatus>();
  msg::NodeStatus status;
  const auto poses = bus.reader<msg::ToolPose>([&](const msg::ToolPose& pose) {
    forces->write({.tool = pose.tool, .seq = pose.seq, .echo_seq = pose.seq, .echo_stamp_ns = pose.stamp_ns});
  });
  until_input_ends(std::chrono::milliseconds(500), [&] {
    ++status.ticks;
    statuses->write(status);
  });
}

// moves a tool until its standard input ends; whether it was answered at least as often as it must be
bool move_a_hand(Bus& bus) {
  constexpr int kEnough = 50;
  std::atomic<int> answers{0};
  const auto poses = bus.writer<msg::ToolPose>();
  const auto forces = bus.reader<msg::ToolForce>([&](const msg::ToolForce&) { ++answers; });
  msg::ToolPose pose;
  until_input_ends(std::chrono::milliseconds(5), [&] {
    ++pose.seq;
    poses->write(pose);
  });
  return answers >= kEnough;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 7) {
    std::cerr
        << "usage: transport_peer <known|durable|organ|blocks|contacts|poses|answers|hand> <fast|cyclone> "
           "<domain> <loopback|lan> [KEYSTORE ROLE]\n";
    return 2;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody is left behind by a test that was killed
  const std::string what = argv[1];
  const auto bus = Bus::open({.vendor = transport::parse_vendor(argv[2]),
                              .domain = std::stoi(argv[3]),
                              .profile = transport::parse_profile(argv[4]),
                              .name = argc == 7 ? argv[6] : what,
                              .keystore = argc == 7 ? argv[5] : ""});
  if (what == "known") send_known(msg::AllTopics{}, *bus);
  if (what == "durable")
    send_durable(msg::TopicList<msg::DeviceInfo, msg::Topology, msg::SceneInfo, msg::NodeStatus>{}, *bus);
  if (what == "organ") send_organ(*bus);
  if (what == "blocks") send_blocks(*bus);
  if (what == "contacts") send_contacts(*bus);
  if (what == "poses") send_poses(*bus);
  if (what == "answers") send_answers(*bus);
  if (what == "hand") return move_a_hand(*bus) ? 0 : 1;
  return 0;
}
