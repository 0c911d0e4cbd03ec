#include "runtime/signals.h"

#include <atomic>
#include <csignal>
#include <ctime>
#include <thread>
#include <utility>

#include <pthread.h>

namespace omentum::runtime {
namespace {

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

struct StopSignal::Impl {
  explicit Impl(std::function<void()> on_stop_) : on_stop(std::move(on_stop_)), signals(stop_signals()) {
    pthread_sigmask(SIG_BLOCK, &signals, &mask_before);
    thread = std::thread([this] { wait(); });
  }

  ~Impl() {
    ending = true;
    pthread_kill(thread.native_handle(), SIGTERM);
    thread.join();
    // a second signal may have come meanwhile; unblocking it now would kill the process on its way out
    const timespec no_time{};
    while (sigtimedwait(&signals, nullptr, &no_time) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
  }

  void wait() {
    for (bool called = false; !ending;) {
      int signal = 0;
      if (sigwait(&signals, &signal) != 0 || ending || called) continue;
      called = true;
      on_stop();
    }
  }

  std::function<void()> on_stop;
  sigset_t signals;
  sigset_t mask_before{};
  std::atomic<bool> ending{false};
  std::thread thread;
};

StopSignal::StopSignal(std::function<void()> on_stop) : impl_(new Impl(std::move(on_stop))) {}
StopSignal::~StopSignal() {
  delete impl_;
}

}  // namespace omentum::runtime
