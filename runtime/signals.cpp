#include "runtime/signals.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

#include <sys/eventfd.h>
#include <unistd.h>

namespace omentum::runtime {
namespace {

constexpr std::array kStopSignals{SIGINT, SIGTERM};

// A handler has no argument but the signal: the one StopSignal's eventfd, -1 when there is none.
std::atomic<int> stop_event{-1};

void ring(int event) noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(event, &one, sizeof one);
}

void on_signal(int) {
  const int errno_before = errno;
  if (const int event = stop_event.load(); event >= 0) ring(event);
  errno = errno_before;
}

}  // namespace

// A handler, not sigwait: libraries such as OpenBLAS start threads before main that do not block the signals,
// and a process-wide signal that any thread takes by default ends the process.
struct StopSignal::Impl {
  explicit Impl(std::function<void()> on_stop_)
      : on_stop(std::move(on_stop_)), event(eventfd(0, EFD_CLOEXEC)) {
    if (event < 0) throw std::runtime_error("signals: the system gave no eventfd");
    thread = std::thread([this] { wait(); });
    stop_event = event;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kStopSignals.size(); ++i) sigaction(kStopSignals[i], &action, &before[i]);
  }

  ~Impl() {
    for (std::size_t i = 0; i < kStopSignals.size(); ++i) sigaction(kStopSignals[i], &before[i], nullptr);
    stop_event = -1;
    ending = true;
    ring(event);
    thread.join();
    close(event);
  }

  void wait() {
    for (bool called = false; !ending;) {
      std::uint64_t rings = 0;
      if (read(event, &rings, sizeof rings) < 0 || ending || called) continue;
      called = true;
      on_stop();
    }
  }

  std::function<void()> on_stop;
  int event;
  std::array<struct sigaction, kStopSignals.size()> before{};
  std::atomic<bool> ending{false};
  std::thread thread;
};

StopSignal::StopSignal(std::function<void()> on_stop) : impl_(new Impl(std::move(on_stop))) {}
StopSignal::~StopSignal() {
  delete impl_;
}

}  // namespace omentum::runtime
