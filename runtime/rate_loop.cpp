#include "runtime/rate_loop.h"

#include "runtime/background.h"
#include "runtime/loop_log.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace omentum::runtime {
namespace {

constexpr double kSlowest_hz = 0.1;
constexpr double kFastest_hz = 100'000;

double checked_rate(double rate_hz) {
  if (!(rate_hz >= kSlowest_hz && rate_hz <= kFastest_hz)) {
    throw std::invalid_argument("loop rate: found " + std::to_string(rate_hz) +
                                " Hz, expected 0.1 to 100000 Hz");
  }
  return rate_hz;
}

std::int64_t period_ns(double rate_hz) {
  return std::llround(1e9 / rate_hz);
}

// Sleeps until `deadline_ns` on the steady clock, or a change of `word` away from `seen`.
void futex_wait_until(std::atomic<std::uint32_t>& word, std::uint32_t seen, std::int64_t deadline_ns) {
  const timespec deadline{deadline_ns / 1'000'000'000, deadline_ns % 1'000'000'000};
  syscall(SYS_futex, &word, FUTEX_WAIT_BITSET_PRIVATE, seen, &deadline, nullptr, FUTEX_BITSET_MATCH_ANY);
}

void futex_wake_one(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

}  // namespace

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t) &&
                  std::atomic<std::uint32_t>::is_always_lock_free,
              "the kernel reads the futex word");

RateLoop::RateLoop(double rate_hz)
    : rate_hz_(checked_rate(rate_hz)), account_(period_ns(rate_hz)), gate_(period_ns(rate_hz)) {}

RateLoop::Cause RateLoop::wait() noexcept {
  for (;;) {
    const std::uint32_t wakes = wakes_.load(std::memory_order_acquire);
    if (stopped_.load(std::memory_order_acquire)) return cause_ = Cause::kStopped;
    const std::int64_t now_ns = steady_now_ns();
    const WakeGate::Open open = gate_.poll(wakes, last_wake_ns_.load(std::memory_order_relaxed), now_ns);
    if (open != WakeGate::Open::kNo) {
      account_.start(now_ns);
      return cause_ = open == WakeGate::Open::kWoken ? Cause::kWoken : Cause::kSchedule;
    }
    futex_wait_until(wakes_, wakes, gate_.ask_again_ns());
  }
}

void RateLoop::finish_tick() noexcept {
  account_.finish(steady_now_ns());
  if (log_ != nullptr) {
    log_->push({account_.last_start_ns(), account_.last_period_ns(), account_.last_compute_ns(),
                static_cast<std::int32_t>(cause_)});
  }
}

void RateLoop::wake() noexcept {
  last_wake_ns_.store(steady_now_ns(), std::memory_order_relaxed);
  wakes_.fetch_add(1, std::memory_order_release);
  futex_wake_one(wakes_);
}

void RateLoop::stop() noexcept {
  stopped_.store(true, std::memory_order_release);
  wake();
}

std::unique_ptr<WokenWork> RateLoop::on_wake(std::function<void()> work) {
  return on_own_thread(std::move(work));
}

std::unique_ptr<SideWork> RateLoop::beside(std::chrono::milliseconds pause, std::function<void()> work) {
  return std::make_unique<Background>(pause, std::move(work));
}

}  // namespace omentum::runtime
