// Runs the peer program and waits for conditions.
#pragma once

#include "tests/support/process.h"
#include "transport/bus.h"

#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace omentum::test {

inline const char* word(transport::Vendor vendor) {
  return vendor == transport::Vendor::kFast ? "fast" : "cyclone";
}

inline const char* word(transport::Profile profile) {
  return profile == transport::Profile::kLan ? "lan" : "loopback";
}

/// Whether an interface other than lo is up and does multicast: what profile `lan` finds its peers through.
inline bool has_lan() {
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) return false;
  constexpr unsigned kNeeded = IFF_UP | IFF_RUNNING | IFF_MULTICAST;
  bool found = false;
  for (const ifaddrs* one = interfaces; one; one = one->ifa_next) {
    const bool inet = one->ifa_addr && one->ifa_addr->sa_family == AF_INET;
    found |= inet && (one->ifa_flags & (kNeeded | IFF_LOOPBACK)) == kNeeded;
  }
  freeifaddrs(interfaces);
  return found;
}

/// The key store of a secured peer, and its part there; empty: unsecured.
struct PeerKeys {
  std::string keystore = {}, role = {};
};

/// The peer (peer.cpp), from the moment its writers exist until this object's end.
class PeerProcess {
 public:
  PeerProcess(const std::string& what, transport::Vendor vendor, int domain,
              transport::Profile profile = transport::Profile::kLoopback, const PeerKeys& keys = {}) {
    int to_peer[2], from_peer[2];
    if (pipe2(to_peer, O_CLOEXEC) != 0 || pipe2(from_peer, O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    const std::string program = std::string(OMENTUM_BIN_DIR).append("/transport_peer");
    const std::string number = std::to_string(domain);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(to_peer[0], STDIN_FILENO);
      dup2(from_peer[1], STDOUT_FILENO);
      // an empty keystore ends the arguments: unsecured
      execl(program.c_str(), program.c_str(), what.c_str(), word(vendor), number.c_str(), word(profile),
            keys.keystore.empty() ? nullptr : keys.keystore.c_str(), keys.role.c_str(), nullptr);
      _exit(127);
    }
    close(to_peer[0]);
    close(from_peer[1]);
    input_ = to_peer[1];
    char letter = 0;
    const bool ready = read(from_peer[0], &letter, 1) == 1;
    close(from_peer[0]);
    if (!ready) throw std::runtime_error(program + " did not start");
  }
  ~PeerProcess() { end(); }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  /// Asks it to end; returns its exit code, or -1 when a signal ended it.
  int end() {
    if (pid_ <= 0) return exit_code_;
    close(input_);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// While it lives the process is stopped, as by a debugger or a laptop's lid. Returns once it stands.
  class Stop {
   public:
    explicit Stop(const PeerProcess& peer) : pid_(peer.pid_) {
      kill(pid_, SIGSTOP);
      int status = 0;
      waitpid(pid_, &status, WUNTRACED);
    }
    ~Stop() { kill(pid_, SIGCONT); }
    Stop(const Stop&) = delete;
    Stop& operator=(const Stop&) = delete;

   private:
    pid_t pid_;
  };
  /// Stops it for a while.
  void freeze(std::chrono::milliseconds time) {
    const Stop stop(*this);
    std::this_thread::sleep_for(time);
  }
  void kill_it() {
    kill(pid_, SIGKILL);
    end();
  }

 private:
  pid_t pid_ = 0;
  int input_ = -1;
  int exit_code_ = 0;
};

/// Waits until the condition holds; false when it does not within a time that only a failure takes.
template <class Condition>
bool eventually(Condition&& condition) {
  constexpr auto kPatience = std::chrono::seconds(25);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace omentum::test
