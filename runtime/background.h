// Work that is done now and then, beside a real-time loop.
#pragma once

#include "runtime/pace.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace omentum::runtime {

/// Calls `work` on a thread of its own, one `pause` after the last call ended; destruction ends the pause and
/// the thread. `work` must not throw.
class Background final : public SideWork {
 public:
  Background(std::chrono::milliseconds pause, std::function<void()> work);
  ~Background() override;
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace omentum::runtime
