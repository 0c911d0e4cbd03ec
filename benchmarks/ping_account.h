// What came back of numbered datagrams, and how late.
#pragma once

#include "runtime/histogram.h"

#include <array>
#include <cstdint>
#include <mutex>

namespace omentum::bench {

/// Round trips by the numbers that datagrams carry: whatever order they come back in, and however often, each
/// counts once. Reads no clock. Any thread; short locks.
class PingAccount {
 public:
  /// How many are remembered: what comes back after so many newer ones were sent is lost. At 1 kHz 8 s.
  static constexpr std::size_t kRemembered = 8192;

  /// Before the datagram is on its way; its number counts from 1.
  std::uint64_t send(std::int64_t now_ns);
  /// false: no number that is awaited.
  bool receive(std::uint64_t seq, std::int64_t now_ns);

  std::uint64_t sent() const;
  std::uint64_t lost() const;  // sent, and not back by now
  runtime::Percentiles round_trip() const;

 private:
  static constexpr std::int64_t kBack = -1;  // nothing is awaited in this place

  mutable std::mutex mutex_;
  std::array<std::int64_t, kRemembered> sent_ns_{};  // of the datagram with that number modulo kRemembered
  std::uint64_t sent_ = 0;
  runtime::Histogram times_;
};

}  // namespace omentum::bench
