#include "runtime/background.h"

#include <utility>

namespace omentum::runtime {

Background::Background(std::chrono::milliseconds pause, std::function<void()> work)
    : thread_([this, pause, work = std::move(work)] {
        for (std::unique_lock lock(mutex_); !changed_.wait_for(lock, pause, [this] { return ending_; });) {
          lock.unlock();
          work();
          lock.lock();
        }
      }) {}

Background::~Background() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace omentum::runtime
