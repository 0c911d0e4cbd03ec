#include "runtime/signals.h"

#include "runtime/clock.h"

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

// A handler has no argument but the signal, and it outlives every StopSignal: what it reads is never
// destroyed.
std::atomic<int> stop_event{-1};               // the one StopSignal's eventfd, -1 when there is none
std::atomic<std::int64_t> ending_since_ns{0};  // steady clock; 0: nobody asked for the end
std::atomic<std::int64_t> patience_ns{0};

void ring(int event) noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(event, &one, sizeof one);
}

// True the first time.
bool begin_to_end() noexcept {
  std::int64_t nobody_asked = 0;
  return ending_since_ns.compare_exchange_strong(nobody_asked, steady_now_ns());
}

void on_signal(int number) {
  const int errno_before = errno;
  if (begin_to_end()) {
    if (const int event = stop_event.load(); event >= 0) ring(event);
  } else if (steady_now_ns() - ending_since_ns > patience_ns) {
    std::signal(number, SIG_DFL);
    raise(number);
  }
  errno = errno_before;
}

void hear_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigset_t held_back;
  sigemptyset(&held_back);
  for (const int number : kStopSignals) {
    sigaction(number, &action, nullptr);
    sigaddset(&held_back, number);
  }
  pthread_sigmask(SIG_UNBLOCK, &held_back, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

// A handler, not sigwait: libraries such as OpenBLAS start threads before main that do not block the signals,
// and a process-wide signal that any thread takes by default ends the process.
struct StopSignal::Impl {
  Impl(std::function<void()> on_stop_, std::chrono::nanoseconds patience)
      : on_stop(std::move(on_stop_)), event(eventfd(0, EFD_CLOEXEC)) {
    if (event < 0) throw std::runtime_error("signals: the system gave no eventfd");
    thread = std::thread([this] { wait(); });
    patience_ns = patience.count();
    stop_event = event;
    ending_since_ns = 0;
    hear_stop_signals();
  }

  // The handler stays: main still has to return, and libraries to end their threads.
  ~Impl() {
    // a handler that was first has yet to ring, and needs the event for it
    if (begin_to_end()) {
      ending = true;
      ring(event);
    }
    thread.join();
    stop_event = -1;
    close(event);
  }

  void wait() {
    std::uint64_t rings = 0;
    while (read(event, &rings, sizeof rings) < 0) continue;
    if (!ending) on_stop();
  }

  std::function<void()> on_stop;
  int event;
  std::atomic<bool> ending{false};
  std::thread thread;
};

StopSignal::StopSignal(std::function<void()> on_stop, std::chrono::nanoseconds patience)
    : impl_(new Impl(std::move(on_stop), patience)) {}
StopSignal::~StopSignal() {
  delete impl_;
}

}  // namespace omentum::runtime
