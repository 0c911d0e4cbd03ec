#include "transport/standstill.h"

#include <ctime>

namespace omentum::transport {

namespace {

// Short beside any lease, long beside what a look costs.
constexpr std::chrono::milliseconds kLookPause{250};

// unlike the steady clock it goes on while the machine is suspended
std::int64_t boot_clock_ns() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

StandstillWatch::StandstillWatch(std::chrono::nanoseconds longest, std::function<bool()> act)
    : standstill_(longest),
      act_(std::move(act)),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

void StandstillWatch::watch(const std::stop_token& stop) {
  bool due = false;
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    due |= standstill_.found(boot_clock_ns());
    if (due) due = !act_();
    wait_.wait_for(lock, stop, kLookPause, [] { return false; });
  }
}

}  // namespace omentum::transport
