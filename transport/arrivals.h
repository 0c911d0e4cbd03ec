// One callback at a time per reader, and none after its end.
#pragma once

#include <atomic>

namespace omentum::transport {

/// Serializes the vendor's "data available" calls of one reader without a lock: a vendor may notify from
/// several threads while it holds locks of its own, so that waiting here could deadlock. A thread that
/// arrives while another is taking samples leaves its arrival to that one.
class Arrivals {
 public:
  /// Runs take_all() until no further arrival was announced meanwhile. Any thread.
  template <class TakeAll>
  void announce(TakeAll&& take_all) {
    if (pending_.fetch_add(1) > 0) return;
    int seen = 1;
    do {
      seen = pending_.load();
      if (!closed_.load()) take_all();
    } while (!pending_.compare_exchange_strong(seen, 0));
    pending_.notify_all();
  }

  /// Waits for a running take_all() and lets none begin. Not from within take_all().
  void close() {
    closed_.store(true);
    for (int pending = pending_.load(); pending != 0; pending = pending_.load()) pending_.wait(pending);
  }

  /// After close(), when the reader that announced is gone: for the next one.
  void open() { closed_.store(false); }

 private:
  std::atomic<int> pending_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace omentum::transport
