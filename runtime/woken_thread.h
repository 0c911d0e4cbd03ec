// Work that is done when a real-time loop asks for it, beside that loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

namespace omentum::runtime {

/// Calls `work` on a thread of its own after each wake(); wakes that come while it works are one. `work` must
/// not throw. Destruction lets it work once more, so that nothing that was handed over before is left, and
/// ends the thread.
class WokenThread {
 public:
  explicit WokenThread(std::function<void()> work);
  ~WokenThread();
  WokenThread(const WokenThread&) = delete;
  WokenThread& operator=(const WokenThread&) = delete;

  /// Any thread. Neither waits nor allocates.
  void wake() noexcept;

 private:
  std::atomic<std::uint32_t> wakes_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace omentum::runtime
