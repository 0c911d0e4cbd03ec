// Why a node that runs must end.
#pragma once

#include "runtime/pace.h"

#include <mutex>
#include <string>

namespace omentum::node {

/// Found on one of the vendor's threads, thrown on the loop's. The first reason counts.
class Refusal {
 public:
  /// `loop` is stopped by a reason; it must outlive this.
  explicit Refusal(runtime::Pace& loop) : loop_(loop) {}

  /// Any thread; waits for a short lock.
  void because(std::string why);
  /// After the loop: throws std::runtime_error with the reason, if there is one.
  void throw_if_any() const;

 private:
  runtime::Pace& loop_;
  mutable std::mutex mutex_;
  std::string why_;
};

}  // namespace omentum::node
