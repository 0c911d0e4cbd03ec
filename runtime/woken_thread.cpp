#include "runtime/woken_thread.h"

#include <utility>

namespace omentum::runtime {

WokenThread::WokenThread(std::function<void()> work)
    : thread_([this, work = std::move(work)] {
        std::uint32_t seen = 0;
        bool last = false;
        while (!last) {
          wakes_.wait(seen);
          seen = wakes_.load();
          last = ending_.load();  // after the count: the wake of the end is never taken for an ordinary one
          work();
        }
      }) {}

WokenThread::~WokenThread() {
  ending_.store(true);
  wake();
  thread_.join();
}

void WokenThread::wake() noexcept {
  wakes_.fetch_add(1);
  wakes_.notify_one();
}

std::unique_ptr<WokenWork> on_own_thread(std::function<void()> work) {
  return std::make_unique<WokenThread>(std::move(work));
}

}  // namespace omentum::runtime
