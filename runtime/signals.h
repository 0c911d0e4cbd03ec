// SIGINT and SIGTERM end a node cleanly.
#pragma once

#include <functional>

namespace omentum::runtime {

/// While it lives, calls `on_stop` once, on a thread of its own, when SIGINT or SIGTERM arrives, whichever
/// thread takes it. One at a time. Throws std::runtime_error where the system gives no eventfd.
class StopSignal {
 public:
  explicit StopSignal(std::function<void()> on_stop);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

 private:
  struct Impl;
  Impl* impl_;
};

}  // namespace omentum::runtime
