// Which writers of a reader's samples have left.
#pragma once

#include "transport/bus.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace omentum::transport {

/// Between the vendor's threads that say who left and the one that takes samples. Any thread; short locks.
///
/// What a writer wrote lies in the reader's history before the vendor says that it left. So whoever takes
/// samples asks who left first, takes them all, and only then hands the departures on: no sample comes after
/// its writer's departure.
class Departures {
 public:
  void delivered(const WriterId& writer) {
    const std::lock_guard lock(mutex_);
    if (std::find(heard_.begin(), heard_.end(), writer) == heard_.end()) heard_.push_back(writer);
  }
  /// Also of a writer whose samples are still to be taken.
  void left(const WriterId& writer) {
    const std::lock_guard lock(mutex_);
    std::erase(heard_, writer);
    left_.push_back(writer);
  }
  /// All that were heard or left, before the reader joins anew: a writer that it hears again is a new one.
  std::vector<WriterId> take_all() {
    const std::lock_guard lock(mutex_);
    left_.insert(left_.end(), heard_.begin(), heard_.end());
    heard_.clear();
    return std::exchange(left_, {});
  }
  /// Who left since the last call.
  std::vector<WriterId> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(left_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<WriterId> heard_, left_;
};

}  // namespace omentum::transport
