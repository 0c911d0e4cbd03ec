// Which answers a device obeys.
#pragma once

#include "transport/latest.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace omentum::device {

enum class AnswerVerdict : std::uint8_t {
  kAccepted,
  kRepeated,  // not newer than an accepted answer that came before
  kForeign,   // answers a pose that this device did not send
  kLate,      // the pose that it answers is too long ago
};

/// Counts the numbers that are missing among one node's answers. Answers that are not ours are of the same
/// sequence when another device moves the same tool, and of any other when another session is met: so they
/// can explain a gap, and never make one. add...() are for one thread, lost() for any.
class AnswerGaps {
 public:
  /// Of an answer to us, in order; `restarted`: the node counts from anew.
  void add_ours(std::uint64_t seq, bool restarted) noexcept;
  /// Of any other answer.
  void add_other(std::uint64_t seq) noexcept;

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  /// Numbers that others' answers may skip and still be taken for the same sequence.
  static constexpr std::uint64_t kSameSequence = 16;

  std::uint64_t followed_ = 0;  // from the newest of ours on, through others' answers
  std::uint64_t skipped_ = 0;   // on that way
  bool begun_ = false;
  std::atomic<std::uint64_t> lost_{0};
};

/// How one tool's answers came in.
struct AnswerCounts {
  std::uint64_t accepted = 0;
  std::uint64_t lost = 0;  // numbers that are missing in the sequence of the answers
  std::uint64_t repeated = 0, foreign = 0, late = 0;

  AnswerCounts& operator+=(const AnswerCounts& other);
};

/// Lets through what answers a recent pose of this device: a force is right only for the hand and the place
/// that it was computed for. Another device on the same tool, an earlier run, and a network that keeps
/// samples back are thus never felt. Stamps are compared with nobody's clock but the device's own. Reads no
/// clock.
class AnswerGate {
 public:
  AnswerGate() noexcept;

  /// The oldest pose whose answer is exerted, s: haptic_node lets a force vanish within 25 ms of its last
  /// pose (stale_s and decay_s), so that what is older was kept back on the way.
  static constexpr double kOldestPose_s = 0.05;
  /// How many poses are remembered: those of kOldestPose_s at up to 10 kHz.
  static constexpr std::size_t kPoses = 512;

  /// Before the pose is published. One thread.
  void sent(std::uint64_t seq, std::int64_t stamp_ns) noexcept;

  /// One thread (the reader's) at a time.
  AnswerVerdict judge(const msg::ToolForce& answer, std::int64_t now_ns) noexcept;

  /// Any thread.
  AnswerCounts counts() const noexcept;

 private:
  AnswerVerdict verdict(const msg::ToolForce& answer, std::int64_t now_ns) noexcept;

  std::array<std::atomic<std::int64_t>, kPoses> stamps_ns_;  // of the pose with that number modulo kPoses
  transport::SequenceTracker sequence_;  // of what is accepted: another session's numbers say nothing of ours
  AnswerGaps gaps_;
  std::array<std::atomic<std::uint64_t>, 4> counts_{};  // by verdict
};

}  // namespace omentum::device
