#include "runtime/wake_gate.h"

#include <algorithm>
#include <limits>

namespace omentum::runtime {
namespace {

constexpr std::int64_t kLongestWindow_ns = 150'000;
constexpr std::uint32_t kLargestBurst = 8;  // tools in one session (idl/common.idl, MAX_TOOLS)
constexpr std::int64_t kLongAgo = std::numeric_limits<std::int64_t>::min() / 4;

}  // namespace

WakeGate::WakeGate(std::int64_t period_ns)
    : period_ns_(period_ns),
      window_ns_(std::min(period_ns / 8, kLongestWindow_ns)),
      grace_ns_(period_ns + period_ns / 2),
      burst_begin_ns_(kLongAgo) {}

WakeGate::Open WakeGate::poll(std::uint32_t wakes, std::int64_t last_wake_ns, std::int64_t now_ns) noexcept {
  const std::uint32_t pending = wakes - served_;
  if (pending == 0) return poll_schedule(now_ns);

  // a straggler of the burst that was served just now: the burst is larger than thought
  if (!gathering_ && last_wake_ns - burst_begin_ns_ < window_ns_) {
    burst_size_ = std::min(burst_size_ + pending, kLargestBurst);
    return open_woken(wakes, now_ns);
  }
  if (!gathering_) burst_begin_ns_ = now_ns;
  gathering_ = true;
  if (pending >= burst_size_) return open_woken(wakes, now_ns);
  ask_again_ns_ = burst_begin_ns_ + window_ns_;
  if (now_ns < ask_again_ns_) return Open::kNo;
  burst_size_ = pending;
  return open_woken(wakes, now_ns);
}

WakeGate::Open WakeGate::open_woken(std::uint32_t wakes, std::int64_t now_ns) noexcept {
  served_ = wakes;
  gathering_ = false;
  begun_ = true;
  due_ns_ = now_ns + grace_ns_;
  return Open::kWoken;
}

WakeGate::Open WakeGate::poll_schedule(std::int64_t now_ns) noexcept {
  if (!begun_) due_ns_ = now_ns + period_ns_;
  begun_ = true;
  ask_again_ns_ = due_ns_;
  if (now_ns < due_ns_) return Open::kNo;
  // periods that passed meanwhile are skipped, not made up for
  due_ns_ += ((now_ns - due_ns_) / period_ns_ + 1) * period_ns_;
  return Open::kSchedule;
}

}  // namespace omentum::runtime
