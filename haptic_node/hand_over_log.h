// A tool that changed hands is said once, and kept for the report.
#pragma once

#include "node_common/tool_holder.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace omentum::haptic {

/// One tool's hand-overs. What two devices that take turns make of it is at most a line a second. One thread
/// at a time.
class HandOverLog {
 public:
  static constexpr std::int64_t kLineEvery_ns = 1'000'000'000;

  void take(const node::HandOver& newest) noexcept { newest_ = newest; }
  /// The line of what was not told yet, where the last one was long enough ago; else empty.
  std::string line(std::uint32_t tool, std::int64_t now_ns);
  /// {"count", "from", "to"}: of the newest one; without names before the first.
  nlohmann::json report() const;

 private:
  node::HandOver newest_;
  std::uint64_t told_ = 0;
  std::int64_t told_ns_ = 0;
};

}  // namespace omentum::haptic
