// Round trip of a ToolPose between two processes on one machine: through our Bus, through the same vendors'
// bare interfaces and through a bare UDP socket, one after the other in every millisecond, so that all three
// meet the same machine; who begins changes from one to the next, so that each is as often the first, on a
// machine that slept, and the last, on one that is awake. Columns: microseconds at the median and the 99th
// percentile, and the Bus as a multiple of the bare vendors at both. "a_b": a device on a, a node on b.
#include "benchmarks/json_reporter.h"
#include "runtime/clock.h"
#include "runtime/histogram.h"
#include "transport/yardstick/bare_link.h"

#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <iostream>
#include <semaphore>
#include <string>
#include <thread>

namespace {

using namespace omentum;
using transport::Bus;
using transport::Vendor;
using transport::yardstick::BareLink;

constexpr int kTrips = 4200;  // a multiple of three links; p99 rests on the 42 slowest
constexpr std::chrono::milliseconds kPeriod{1};
// A reply that takes longer counts as lost.
constexpr std::chrono::milliseconds kPatience{20};

const char* word(Vendor vendor) {
  return vendor == Vendor::kFast ? "fast" : "cyclone";
}

/// Sends numbered samples and measures, on the receiving thread, how long each reply took.
class PingPong {
 public:
  virtual ~PingPong() = default;

  /// Whether the reply came. In a first phase trips are made without being counted.
  bool trip(bool count) {
    const std::uint64_t seq = ++seq_;
    sent_ns_ = runtime::steady_now_ns();
    send(seq);
    // a late reply to an earlier sample gives its number, and the wait goes on
    while (replies_.try_acquire_for(kPatience))
      if (replied_seq_ == seq) {
        if (count) times_.add_ns(reply_ns_ - sent_ns_);
        return true;
      }
    lost_ += count;
    return false;
  }

  void report(benchmark::State& state, const std::string& name) const {
    state.counters[name + "_p50_us"] = times_.percentile_us(0.5);
    state.counters[name + "_p99_us"] = times_.percentile_us(0.99);
    state.counters[name + "_lost"] = lost_;
  }
  double percentile_us(double share) const { return times_.percentile_us(share); }

 protected:
  virtual void send(std::uint64_t seq) = 0;
  void on_reply(std::uint64_t seq) {
    reply_ns_ = runtime::steady_now_ns();
    replied_seq_ = seq;
    replies_.release();
  }

 private:
  std::uint64_t seq_ = 0;
  std::int64_t sent_ns_ = 0;
  std::atomic<std::int64_t> reply_ns_{0};
  std::atomic<std::uint64_t> replied_seq_{0};
  std::counting_semaphore<> replies_{0};
  runtime::Histogram times_;
  int lost_ = 0;
};

class BusPing final : public PingPong {
 public:
  BusPing(Vendor vendor, int domain)
      : bus_(Bus::open({.vendor = vendor, .domain = domain, .name = "bench device"})),
        writer_(bus_->writer<msg::ToolPose>()),
        reader_(
            bus_->reader<msg::ToolForce>([this](const msg::ToolForce& force) { on_reply(force.echo_seq); })) {
  }

 private:
  void send(std::uint64_t seq) override {
    pose_.seq = seq;
    writer_->write(pose_);
  }

  msg::ToolPose pose_;
  std::unique_ptr<Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> writer_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> reader_;
};

class BarePing final : public PingPong {
 public:
  BarePing(Vendor vendor, int domain)
      : link_(BareLink::open(vendor, domain, BareLink::End::kPing,
                             [this](const msg::ToolPose& pose) { on_reply(pose.seq); })) {}

 private:
  void send(std::uint64_t seq) override {
    pose_.seq = seq;
    link_->send(pose_);
  }

  msg::ToolPose pose_;
  std::unique_ptr<BareLink> link_;
};

/// A UDP socket on 127.0.0.1; port 0: any.
class Socket {
 public:
  explicit Socket(std::uint16_t port) : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address = on_loopback(0);
    bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    if (port == 0) return;
    sockaddr_in peer = on_loopback(port);
    connect(fd_, reinterpret_cast<sockaddr*>(&peer), sizeof peer);
  }
  ~Socket() { ::close(fd_); }

  int fd() const { return fd_; }
  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

 private:
  static sockaddr_in on_loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  int fd_;
};

class UdpPing final : public PingPong {
 public:
  explicit UdpPing(std::uint16_t port) : socket_(port), receiver_([this] { receive(); }) {}
  ~UdpPing() override {
    shutdown(socket_.fd(), SHUT_RDWR);
    receiver_.join();
  }

 private:
  void send(std::uint64_t seq) override {
    pose_.seq = seq;
    if (::send(socket_.fd(), &pose_, sizeof pose_, 0) < 0) return;  // counts as lost
  }
  void receive() {
    msg::ToolPose pose;
    while (recv(socket_.fd(), &pose, sizeof pose, 0) == sizeof pose) on_reply(pose.seq);
  }

  msg::ToolPose pose_;
  Socket socket_;
  std::thread receiver_;
};

/// The other process: answers on all three links until its standard input ends.
int echo(Vendor vendor, int domain) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto bus = Bus::open({.vendor = vendor, .domain = domain, .name = "bench node"});
  const auto writer = bus->writer<msg::ToolForce>();
  msg::ToolForce force;
  const auto reader = bus->reader<msg::ToolPose>([&](const msg::ToolPose& pose) {
    force.echo_seq = pose.seq;
    writer->write(force);
  });
  // its own domain: Cyclone has one configuration per domain and process
  BareLink* bare = nullptr;
  const auto link =
      BareLink::open(vendor, domain + 1, BareLink::End::kPong, [&bare](const msg::ToolPose& pose) {
        if (bare) bare->send(pose);
      });
  bare = link.get();
  const Socket socket(0);
  std::thread udp([&] {
    msg::ToolPose pose;
    sockaddr_in from{};
    for (;;) {
      socklen_t size = sizeof from;
      auto* address = reinterpret_cast<sockaddr*>(&from);
      if (recvfrom(socket.fd(), &pose, sizeof pose, 0, address, &size) != sizeof pose) return;
      sendto(socket.fd(), &pose, sizeof pose, 0, address, size);
    }
  });
  std::cout << socket.port() << std::endl;
  char byte;
  while (read(STDIN_FILENO, &byte, 1) > 0) continue;
  shutdown(socket.fd(), SHUT_RDWR);
  udp.join();
  return 0;
}

class EchoProcess {
 public:
  EchoProcess(Vendor vendor, int domain) {
    int to_echo[2], from_echo[2];
    if (pipe(to_echo) != 0 || pipe(from_echo) != 0) throw std::runtime_error("no pipe");
    const std::string number = std::to_string(domain);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(to_echo[0], STDIN_FILENO);
      dup2(from_echo[1], STDOUT_FILENO);
      for (const int end : {to_echo[0], to_echo[1], from_echo[0], from_echo[1]}) close(end);
      execl("/proc/self/exe", "round_trip_bench", "--echo", word(vendor), number.c_str(), nullptr);
      _exit(127);
    }
    close(to_echo[0]);
    close(from_echo[1]);
    input_ = to_echo[1];
    char text[16] = {};
    const bool ready = read(from_echo[0], text, sizeof text - 1) > 0;
    close(from_echo[0]);
    if (!ready) throw std::runtime_error("the echo process did not start");
    port_ = static_cast<std::uint16_t>(std::stoi(text));
  }
  ~EchoProcess() {
    close(input_);
    waitpid(pid_, nullptr, 0);
  }
  std::uint16_t port() const { return port_; }

 private:
  pid_t pid_ = 0;
  int input_ = -1;
  std::uint16_t port_ = 0;
};

/// Trips until replies come (discovery takes up to some seconds), then some to warm up; false: none came.
bool settle(PingPong& link) {
  constexpr int kAttempts = 1000, kWarm = 200;
  int replies = 0;
  for (int attempt = 0; attempt < kAttempts && replies < kWarm; ++attempt) replies += link.trip(false);
  return replies == kWarm;
}

void round_trip(benchmark::State& state, Vendor device, Vendor node) {
  static int runs = 0;
  const int domain = 1 + (getpid() + 2 * runs++) % 99;  // beyond 100 a domain's ports may be any program's
  const EchoProcess other(node, domain);
  BusPing bus(device, domain);
  BarePing bare(device, domain + 1);
  UdpPing udp(other.port());
  const std::pair<PingPong*, const char*> links[] = {{&udp, "udp"}, {&bare, "bare"}, {&bus, "bus"}};
  for (const auto& [link, name] : links) {
    if (settle(*link)) continue;
    state.SkipWithError((std::string("no replies: ") + name).c_str());
    return;
  }
  auto next = std::chrono::steady_clock::now();
  std::size_t first = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < std::size(links); ++i) {
      links[(first + i) % std::size(links)].first->trip(true);
    }
    ++first;
    next += kPeriod;
    std::this_thread::sleep_until(next);
  }
  for (const auto& [link, name] : links) link->report(state, name);
  const auto ratio = [&](const PingPong& to, double share) {
    return bus.percentile_us(share) / to.percentile_us(share);
  };
  state.counters["bus_per_bare"] = ratio(bare, 0.5);
  state.counters["bus_per_bare_p99"] = ratio(bare, 0.99);
  state.counters["bus_per_udp"] = ratio(udp, 0.5);
}

std::string name_of(Vendor device, Vendor node) {
  return std::string("round_trip/") + word(device) + "_" + word(node);
}

void compare(bench::Results& results, const std::string& name) {
  for (const char* share : {"_p50_us", "_p99_us"})
    results.compare(name + "/bus" + share, name + "/bare" + share);
}

void add(Vendor device, Vendor node) {
  benchmark::RegisterBenchmark(name_of(device, node).c_str(),
                               [=](benchmark::State& state) { round_trip(state, device, node); })
      ->Iterations(kTrips)
      ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "--echo") == 0)
    return echo(transport::parse_vendor(argv[2]), std::stoi(argv[3]));
  bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  for (const Vendor device : {Vendor::kFast, Vendor::kCyclone})
    for (const Vendor node : {Vendor::kFast, Vendor::kCyclone}) add(device, node);
  bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Vendor device : {Vendor::kFast, Vendor::kCyclone})
    for (const Vendor node : {Vendor::kFast, Vendor::kCyclone}) compare(results, name_of(device, node));
  results.write();
  return 0;
}
