// Work that is done when a real-time loop asks for it, beside that loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

namespace omentum::runtime {

/// Is done after each wake(); wakes that come while it is being done are one. Destruction does it once more,
/// so that nothing that was handed over before is left.
class WokenWork {
 public:
  virtual ~WokenWork() = default;
  /// Any thread. Neither waits nor allocates.
  virtual void wake() noexcept = 0;
};

/// How work is made to wait for its wakes: on a thread of its own, or, where a script says when things happen
/// (a test's), on that script's. `work` must not throw.
using StartWork = std::function<std::unique_ptr<WokenWork>(std::function<void()> work)>;

class WokenThread final : public WokenWork {
 public:
  explicit WokenThread(std::function<void()> work);
  ~WokenThread() override;
  WokenThread(const WokenThread&) = delete;
  WokenThread& operator=(const WokenThread&) = delete;

  void wake() noexcept override;

 private:
  std::atomic<std::uint32_t> wakes_{0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// The StartWork of programs.
std::unique_ptr<WokenWork> on_own_thread(std::function<void()> work);

}  // namespace omentum::runtime
