#include "organ_tools/organ_build/interruption.h"

#include <atomic>
#include <csignal>

namespace omentum::organ_tools {

namespace {

// A signal handler can reach nothing but what has static storage.
std::atomic<bool> signal_came{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a handler may only touch lock-free atomics");

// Whoever asks twice meets a program that does not come to look: it ends as if there were no handler. Its
// partial file loses its lock, and the next organ_build removes it.
extern "C" void note_signal(int number) {
  if (signal_came.exchange(true)) {
    std::signal(number, SIG_DFL);
    raise(number);
  }
}

}  // namespace

void watch_for_interruption() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() noexcept {
  return signal_came;
}

}  // namespace omentum::organ_tools
