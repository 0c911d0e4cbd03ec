// The faults of a node: raised anywhere, read by its status and its report.
#pragma once

#include "messages/common.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace omentum::runtime {

/// A distinct fault, e.g. "tool 1: position is not finite".
struct Fault {
  std::string text;
  double first_s = 0;  // since the node's start
  std::uint64_t count = 0;
};

/// At most 16 distinct texts of at most 100 characters, each with its first time and count; what goes beyond
/// is counted as "further faults". Any thread may raise and any may read.
class FaultList {
 public:
  static constexpr int kCapacity = msg::MAX_FAULTS - 1;  // "further faults" has room
  static constexpr int kTextSize = 100;

  FaultList() noexcept;

  /// Neither waits nor allocates. A longer text is cut.
  void raise(std::string_view text) noexcept;

  bool any() const noexcept { return entries_[0].state.load(std::memory_order_acquire) == kReady; }
  std::vector<Fault> list() const;
  /// One line each: "TEXT (first at 3.2 s, 12 times)", for NodeStatus and the report.
  std::vector<std::string> lines() const;

 private:
  enum State : std::uint8_t { kEmpty, kFilling, kReady };
  struct Entry {
    std::atomic<std::uint8_t> state{kEmpty};
    std::array<char, kTextSize> text{};
    std::uint8_t size = 0;
    std::int64_t first_ns = 0;
    std::atomic<std::uint64_t> count{0};
  };

  std::int64_t begin_ns_;
  std::array<Entry, kCapacity> entries_;
  std::atomic<std::uint64_t> further_{0};
};

}  // namespace omentum::runtime
