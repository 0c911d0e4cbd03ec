// A slow, lossy Ethernet between network namespaces, where the kernel has no netem: a TAP device in each of
// them, and every frame of one goes to all others, late or never.
//
//   lossy_hub --delay-ms 1 --loss 0.01 [--cut FROM_S:FOR_S] NAMESPACE=ADDRESS/BITS ...
//
// Namespaces are those of `ip netns`. Prints "ready", then works until its standard input ends.
#include "runtime/command_line.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr const char* kDevice = "lan0";

struct Options {
  double delay_ms = 0, loss = 0, cut_from_s = -1, cut_for_s = 0;
  std::vector<std::string> hosts;
};

void run_or_throw(const std::string& command) {
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

// opened here, and moved to its namespace: the file goes on working
int open_tap(const std::string& host) {
  const auto equals = host.find('=');
  if (equals == std::string::npos) throw std::runtime_error(host + ": expected NAMESPACE=ADDRESS/BITS");
  const std::string space = host.substr(0, equals), address = host.substr(equals + 1);
  const int file = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  std::snprintf(request.ifr_name, sizeof request.ifr_name, "omtap%%d");
  if (file < 0 || ioctl(file, TUNSETIFF, &request) < 0)
    throw std::runtime_error("no TAP device: are you root?");
  const std::string ip = "ip -n " + space + " ";
  run_or_throw(std::string("ip link set ") + request.ifr_name + " netns " + space + " name " + kDevice);
  run_or_throw(ip + "addr add " + address + " dev " + kDevice);
  run_or_throw(ip + "link set lo up");
  run_or_throw(ip + "link set " + kDevice + " up");
  run_or_throw(ip + "route add 224.0.0.0/4 dev " + kDevice);
  return file;
}

/// Frames on their way, in the order in which they came.
class Hub {
 public:
  explicit Hub(const Options& options) : options_(options) {
    for (const std::string& host : options.hosts) ports_.push_back({.fd = open_tap(host), .events = POLLIN});
  }

  void work() {
    std::vector<pollfd> waiting = ports_;
    waiting.push_back({.fd = STDIN_FILENO, .events = POLLIN});
    while (true) {
      poll(waiting.data(), waiting.size(), patience_ms());
      if (waiting.back().revents != 0) return;
      for (std::size_t port = 0; port < ports_.size(); ++port)
        if ((waiting[port].revents & POLLIN) != 0) take_all(port);
      deliver();
    }
  }

 private:
  struct Frame {
    Clock::time_point due;
    std::size_t from;
    std::vector<char> bytes;
  };

  int patience_ms() const {
    constexpr int kLongest_ms = 100;
    if (frames_.empty()) return kLongest_ms;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(frames_.front().due - Clock::now());
    return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
  }

  bool cut() const {
    const double now_s = Seconds(Clock::now() - begin_).count();
    return now_s >= options_.cut_from_s && now_s < options_.cut_from_s + options_.cut_for_s;
  }

  void take_all(std::size_t port) {
    const auto due =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(1e-3 * options_.delay_ms));
    for (ssize_t size; (size = read(ports_[port].fd, frame_.data(), frame_.size())) > 0;) {
      if (cut() || std::bernoulli_distribution(options_.loss)(chance_)) continue;
      frames_.push_back({due, port, {frame_.data(), frame_.data() + size}});
    }
  }

  void deliver() {
    for (; !frames_.empty() && frames_.front().due <= Clock::now(); frames_.pop_front())
      for (std::size_t to = 0; to < ports_.size(); ++to)
        if (to != frames_.front().from) {
          // a full queue loses frames, as a switch does
          const auto& bytes = frames_.front().bytes;
          if (write(ports_[to].fd, bytes.data(), bytes.size()) < 0) continue;
        }
  }

  Options options_;
  std::vector<pollfd> ports_;
  std::deque<Frame> frames_;
  std::array<char, 65536> frame_{};
  Clock::time_point begin_ = Clock::now();
  std::minstd_rand chance_{1};  // the same losses in every run
};

}  // namespace

int main(int argc, char** argv) {
  omentum::runtime::CommandLine line("lossy_hub", "A slow, lossy Ethernet between network namespaces.");
  Options options;
  std::string cut;
  line.option("--delay-ms", options.delay_ms, "of every frame").between(0.0, 1000.0).show_default();
  line.option("--loss", options.loss, "share of the frames").between(0.0, 1.0).show_default();
  line.option("--cut", cut, "nothing passes from then on, for so long, s").type_name("FROM:FOR");
  line.option("hosts", options.hosts, "NAMESPACE=ADDRESS/BITS").required();
  return line.run(argc, argv, [&] {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind by a test that was killed
    if (!cut.empty() && std::sscanf(cut.c_str(), "%lf:%lf", &options.cut_from_s, &options.cut_for_s) != 2)
      throw std::runtime_error("--cut " + cut + ": expected FROM:FOR");
    Hub hub(options);
    std::puts("ready");
    std::fflush(stdout);
    hub.work();
  });
}
