// How long the world took to answer a device's poses, on the device's own clock.
#pragma once

#include "runtime/histogram.h"
#include "transport/messages.h"

#include <array>
#include <cstdint>
#include <mutex>

namespace omentum::device {

/// What the report says of the answers.
struct AnswerReport {
  runtime::Percentiles to_force, to_organ, to_picture;
  std::uint64_t unanswered = 0;  // poses between the first and the last answered one that no answer echoes
};

/// Times each pose's first answer: the force, the organ and the picture that take it into account. Echoes of
/// poses that this process never sent (an earlier run's durable samples, another device's tools) do not
/// count. Reads no clock. Any thread; short locks, so not for the loop.
class AnswerBook {
 public:
  /// `begin_ns`: poses sent before do not count.
  explicit AnswerBook(std::int64_t begin_ns) : begin_ns_(begin_ns) {}

  void serve(std::uint32_t tool);  // an answer to this tool's poses counts
  /// An answer to a pose of this device, in order (AnswerGate).
  void add(const msg::ToolForce& answer, std::int64_t now_ns);
  void add(const msg::NodeStatus& status, std::int64_t now_ns);

  AnswerReport report() const;

 private:
  enum Kind { kForce, kOrgan, kPicture, kKinds };
  struct Tool {
    bool served = false;
    std::uint64_t echo_seq = 0;                    // of the newest pose that was answered; 0: none yet
    std::array<std::int64_t, kKinds> newest_ns{};  // stamp of the newest pose answered
  };

  void add(Kind kind, std::uint32_t tool, std::int64_t stamp_ns, std::int64_t now_ns);

  std::int64_t begin_ns_;
  mutable std::mutex mutex_;
  std::array<Tool, msg::MAX_TOOLS> tools_;
  std::array<runtime::Histogram, kKinds> latency_;
  std::uint64_t unanswered_ = 0;
};

}  // namespace omentum::device
