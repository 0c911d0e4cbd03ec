// SIGINT and SIGTERM end a node cleanly; a pipe that nobody reads any more does not end it.
#pragma once

#include <chrono>
#include <functional>

namespace omentum::runtime {

/// While it lives, calls `on_stop` once, on a thread of its own, when SIGINT or SIGTERM arrives, whichever
/// thread takes it; also for one that came before and was held back, which a launcher does for as long as
/// nobody would hear it. One at a time, made by the main thread. Throws std::runtime_error where the system
/// gives no eventfd.
///
/// From the first signal on, or from the object's own end, the program is ending, and until the process is
/// gone a further signal is the same wish again: it changes nothing, also while statics are destroyed. Only
/// one that comes later than `patience` after that has met a program that hangs, and ends it as if there were
/// no handler.
///
/// SIGPIPE is ignored from here on: the hand's loop must not end because whoever read what it prints did.
class StopSignal {
 public:
  /// Longer than launchers repeat themselves, and no longer than a person waits.
  static constexpr std::chrono::seconds kPatience{5};

  explicit StopSignal(std::function<void()> on_stop, std::chrono::nanoseconds patience = kPatience);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

 private:
  struct Impl;
  Impl* impl_;
};

}  // namespace omentum::runtime
