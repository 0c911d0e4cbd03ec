// A bare UDP ping-pong between two machines: what DDS and the nodes are compared with (network_bench.py).
//
//   udp_ping --echo                                                     prints its port, then answers
//   udp_ping --to ADDRESS --port PORT --rate-hz 1000 --bytes 152 --back-bytes 112
//
// Both work until standard input ends. The second one then prints a line of JSON: sent, lost, round_trip_us.
// Its threads have the hand's priority, as those of the nodes that stand beside it.
#include "benchmarks/ping_account.h"
#include "runtime/clock.h"
#include "runtime/command_line.h"
#include "runtime/realtime.h"
#include "runtime/report.h"

#include <arpa/inet.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iostream>
#include <system_error>
#include <thread>

namespace {

using namespace omentum;

struct Options {
  bool echo = false;
  std::string to = "127.0.0.1";
  int port = 0, bytes = 64, back_bytes = 64;
  double rate_hz = 1000;
};

/// Begins each datagram; the rest is zeros.
struct Head {
  std::uint64_t seq;
  std::uint32_t back_bytes;  // how long the answer is to be
};
constexpr int kLeastBytes = sizeof(Head), kMostBytes = 65000;

/// A UDP socket of this machine, on any port.
class Socket {
 public:
  Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in any{
        .sin_family = AF_INET, .sin_port = 0, .sin_addr = {.s_addr = INADDR_ANY}, .sin_zero = {}};
    require(fd_ >= 0 && bind(fd_, reinterpret_cast<const sockaddr*>(&any), sizeof any) == 0);
  }
  ~Socket() { close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void connect_to(const std::string& address, int port) {
    sockaddr_in peer{};
    peer.sin_family = AF_INET;
    peer.sin_port = htons(static_cast<std::uint16_t>(port));
    if (inet_pton(AF_INET, address.c_str(), &peer.sin_addr) != 1)
      throw std::runtime_error("--to: found " + address + ", expected an IPv4 address");
    require(connect(fd_, reinterpret_cast<const sockaddr*>(&peer), sizeof peer) == 0);
  }
  int fd() const { return fd_; }
  int port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    require(getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    return ntohs(address.sin_port);
  }

 private:
  static void require(bool done) {
    if (!done) throw std::system_error(errno, std::generic_category(), "UDP socket");
  }
  int fd_;
};

void wait_for_the_end() {
  for (char byte; read(STDIN_FILENO, &byte, 1) > 0;) continue;
}

void answer(int fd) {
  std::vector<char> bytes(kMostBytes);
  sockaddr_in from{};
  auto* address = reinterpret_cast<sockaddr*>(&from);
  while (true) {
    socklen_t size = sizeof from;
    const ssize_t got = recvfrom(fd, bytes.data(), bytes.size(), 0, address, &size);
    if (got < kLeastBytes || size == 0) return;  // shut down
    Head head;
    std::memcpy(&head, bytes.data(), sizeof head);
    const auto back = std::clamp<std::size_t>(head.back_bytes, kLeastBytes, kMostBytes);
    // one that the way does not take is one that is lost
    if (sendto(fd, bytes.data(), back, 0, address, size) < 0) continue;
  }
}

void echo() {
  const Socket socket;
  std::thread answering;
  {
    const runtime::RealtimeStart start(runtime::kHandLinkPriority);
    answering = std::thread([&socket] { answer(socket.fd()); });
  }
  std::cout << socket.port() << std::endl;
  wait_for_the_end();
  shutdown(socket.fd(), SHUT_RDWR);
  answering.join();
}

// A thread that overslept leaves pings out: several at once would meet a queue of their own.
void send_all(int fd, const Options& options, bench::PingAccount& account, const std::atomic<bool>& ended) {
  using Clock = std::chrono::steady_clock;
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / options.rate_hz));
  std::vector<char> bytes(static_cast<std::size_t>(options.bytes));
  for (auto next = Clock::now(); !ended; next = std::max(next + period, Clock::now())) {
    std::this_thread::sleep_until(next);
    const Head head{account.send(runtime::steady_now_ns()), static_cast<std::uint32_t>(options.back_bytes)};
    std::memcpy(bytes.data(), &head, sizeof head);
    if (send(fd, bytes.data(), bytes.size(), 0) < 0) continue;  // it counts as lost
  }
}

void receive_all(int fd, bench::PingAccount& account) {
  std::vector<char> bytes(kMostBytes);
  while (true) {
    const ssize_t got = recv(fd, bytes.data(), bytes.size(), 0);
    const std::int64_t now_ns = runtime::steady_now_ns();
    if (got == 0 || (got < 0 && errno != ECONNREFUSED)) return;  // shut down
    Head head{};
    if (got >= kLeastBytes) std::memcpy(&head, bytes.data(), sizeof head);
    account.receive(head.seq, now_ns);
  }
}

void ping(const Options& options) {
  constexpr std::chrono::milliseconds kLateOnes{500};  // what is on its way at the end still counts
  Socket socket;
  socket.connect_to(options.to, options.port);
  bench::PingAccount account;
  std::atomic<bool> ended = false;
  std::thread receiving, sending;
  {
    const runtime::RealtimeStart start(runtime::kHandLinkPriority);
    receiving = std::thread([&] { receive_all(socket.fd(), account); });
    sending = std::thread([&] { send_all(socket.fd(), options, account, ended); });
  }
  wait_for_the_end();
  ended = true;
  sending.join();
  std::this_thread::sleep_for(kLateOnes);
  shutdown(socket.fd(), SHUT_RDWR);
  receiving.join();
  std::cout << nlohmann::json{{"sent", account.sent()},
                              {"lost", account.lost()},
                              {"round_trip_us", runtime::to_json(account.round_trip())}}
            << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("udp_ping", "A bare UDP ping-pong between two machines.");
  Options options;
  line.flag("--echo", options.echo, "answer the other one; prints the port");
  line.option("--to", options.to, "address of the one that answers").show_default();
  line.option("--port", options.port, "... and its port").between(0, 65535);
  line.option("--rate-hz", options.rate_hz, "datagrams a second").between(1.0, 10000.0).show_default();
  line.option("--bytes", options.bytes, "of a datagram").between(kLeastBytes, kMostBytes).show_default();
  line.option("--back-bytes", options.back_bytes, "of the answer")
      .between(kLeastBytes, kMostBytes)
      .show_default();
  return line.run(argc, argv, [&] {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left behind by a bench that was killed
    if (options.echo) return echo();
    ping(options);
  });
}
