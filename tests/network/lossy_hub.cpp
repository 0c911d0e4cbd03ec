// A slow, lossy Ethernet between network namespaces, where the kernel has no netem: a TAP device in each of
// them, and a frame of one goes to the one that it is for, or to all others, late or never.
//
//   lossy_hub --delay-ms 1 --jitter-ms 0.5 [--overtake] --loss 0.01 [--cut FROM_S:FOR_S]
//   NAMESPACE=ADDRESS/BITS ...
//
// Namespaces are those of `ip netns`. Prints "ready", then works until its standard input ends, and prints a
// line of JSON: frames and bytes that it was given, and how many of them were for everybody (multicast,
// broadcast).
#include "runtime/command_line.h"
#include "runtime/realtime.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr const char* kDevice = "lan0";
// Above the hand's own: a wire does not wait until the programs at its ends leave it a processor.
constexpr int kPriority = omentum::runtime::kHandLoopPriority + 1;

struct Options {
  double delay_ms = 0, jitter_ms = 0, loss = 0, cut_from_s = -1, cut_for_s = 0;
  bool overtake = false;
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

struct Count {
  std::uint64_t frames = 0, bytes = 0;
  void add(std::size_t size) {
    ++frames;
    bytes += size;
  }
};

/// Where hosts are, by what they sent: as a switch learns it, so that nobody is woken by others' frames.
class Places {
 public:
  static constexpr std::size_t kEverybody = SIZE_MAX;

  /// Where the frame is for, which came from `port`; not known, or for a group: kEverybody.
  std::size_t of(std::span<const char> frame, std::size_t port) {
    if (frame.size() < 2 * kSize) return kEverybody;
    const std::string to(frame.data(), kSize), from(frame.data() + kSize, kSize);
    ports_[from] = port;
    const auto found = ports_.find(to);
    return found == ports_.end() ? kEverybody : found->second;
  }

 private:
  static constexpr std::size_t kSize = 6;  // of an address; a frame begins with two
  std::map<std::string, std::size_t> ports_;
};

/// Frames on their way.
class Hub {
 public:
  explicit Hub(const Options& options) : options_(options) {
    for (const std::string& host : options.hosts)
      ports_.push_back({.fd = open_tap(host), .events = POLLIN, .revents = 0});
  }

  void work() {
    std::vector<pollfd> waiting = ports_;
    waiting.push_back({.fd = STDIN_FILENO, .events = POLLIN, .revents = 0});
    while (true) {
      const timespec patience = until_due();
      ppoll(waiting.data(), waiting.size(), &patience, nullptr);
      if (waiting.back().revents != 0) return;
      for (std::size_t port = 0; port < ports_.size(); ++port)
        if ((waiting[port].revents & POLLIN) != 0) take_all(port);
      deliver();
    }
  }

  void tell() const {
    std::printf(R"({"frames": %ju, "bytes": %ju, "shared_frames": %ju, "shared_bytes": %ju})"
                "\n",
                all_.frames, all_.bytes, shared_.frames, shared_.bytes);
  }

 private:
  struct Frame {
    std::size_t from, to;
    std::vector<char> bytes;
  };

  // not in whole milliseconds, as poll() has it: a delay of one would be one to two
  timespec until_due() const {
    constexpr std::chrono::nanoseconds kLongest{100'000'000}, kNone{0};
    if (frames_.empty()) return {.tv_sec = 0, .tv_nsec = kLongest.count()};
    const std::chrono::nanoseconds left = frames_.begin()->first - Clock::now();
    return {.tv_sec = 0, .tv_nsec = std::clamp(left, kNone, kLongest).count()};
  }

  bool cut() const {
    const double now_s = Seconds(Clock::now() - begin_).count();
    return now_s >= options_.cut_from_s && now_s < options_.cut_from_s + options_.cut_for_s;
  }

  static Clock::duration milliseconds(double ms) {
    return std::chrono::duration_cast<Clock::duration>(Seconds(1e-3 * ms));
  }

  // Without --overtake as a queue on the way, which is now longer and now shorter: in order, by host.
  Clock::time_point due(std::size_t port) {
    constexpr double kQueueStays_ms = 30;
    const Clock::time_point now = Clock::now();
    if (options_.overtake || now >= queue_until_) {
      late_ms_ = std::uniform_real_distribution(0.0, options_.jitter_ms)(chance_);
      queue_until_ = now + milliseconds(kQueueStays_ms);
    }
    const Clock::time_point asked = now + milliseconds(options_.delay_ms + late_ms_);
    if (options_.overtake) return asked;
    return newest_due_[port] = std::max(newest_due_[port], asked);
  }

  void count(std::size_t size) {
    all_.add(size);
    if ((frame_[0] & 1) != 0) shared_.add(size);  // the group bit of Ethernet's destination
  }

  void take_all(std::size_t port) {
    for (ssize_t size; (size = read(ports_[port].fd, frame_.data(), frame_.size())) > 0;) {
      const std::span frame(frame_.data(), static_cast<std::size_t>(size));
      count(frame.size());
      const std::size_t to = places_.of(frame, port);
      if (cut() || std::bernoulli_distribution(options_.loss)(chance_)) continue;
      frames_.emplace(due(port), Frame{port, to, {frame.begin(), frame.end()}});
    }
  }

  void deliver() {
    for (; !frames_.empty() && frames_.begin()->first <= Clock::now(); frames_.erase(frames_.begin())) {
      const Frame& frame = frames_.begin()->second;
      for (std::size_t to = 0; to < ports_.size(); ++to)
        if (to != frame.from && (frame.to == Places::kEverybody || frame.to == to)) send(frame.bytes, to);
    }
  }

  void send(const std::vector<char>& bytes, std::size_t port) {
    // a full queue loses frames, as a switch does
    if (write(ports_[port].fd, bytes.data(), bytes.size()) < 0) return;
  }

  Options options_;
  std::vector<pollfd> ports_;
  Places places_;
  std::multimap<Clock::time_point, Frame> frames_;  // by when they are due; equal ones as they came
  Count all_, shared_;
  std::array<char, 65536> frame_{};
  Clock::time_point begin_ = Clock::now();
  double late_ms_ = 0;
  Clock::time_point queue_until_{};
  std::vector<Clock::time_point> newest_due_ = std::vector<Clock::time_point>(options_.hosts.size());
  std::minstd_rand chance_{1};  // the same losses in every run
};

}  // namespace

int main(int argc, char** argv) {
  omentum::runtime::CommandLine line("lossy_hub", "A slow, lossy Ethernet between network namespaces.");
  Options options;
  std::string cut;
  line.option("--delay-ms", options.delay_ms, "of every frame").between(0.0, 1000.0).show_default();
  line.option("--jitter-ms", options.jitter_ms, "each frame comes up to so much later")
      .between(0.0, 1000.0)
      .show_default();
  line.flag("--overtake", options.overtake,
            "... each by a chance of its own, so that frames overtake each other");
  line.option("--loss", options.loss, "share of the frames").between(0.0, 1.0).show_default();
  line.option("--cut", cut, "nothing passes from then on, for so long, s").type_name("FROM:FOR");
  line.option("hosts", options.hosts, "NAMESPACE=ADDRESS/BITS").required();
  return line.run(argc, argv, [&] {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind by a test that was killed
    if (!cut.empty() && std::sscanf(cut.c_str(), "%lf:%lf", &options.cut_from_s, &options.cut_for_s) != 2)
      throw std::runtime_error("--cut " + cut + ": expected FROM:FOR");
    Hub hub(options);
    omentum::runtime::request_realtime(kPriority);
    std::puts("ready");
    std::fflush(stdout);
    hub.work();
    hub.tell();
  });
}
