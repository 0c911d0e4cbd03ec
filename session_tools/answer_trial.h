// What a device makes of its answers (docs/devices.md, "What a device must do"), tried from haptic_node's
// place.
#pragma once

#include "session_tools/verdict.h"
#include "transport/messages.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_set>
#include <vector>

namespace omentum::session {

/// How long each part of a trial lasts, s, in this order, and what the hand feels in it.
struct TrialTimes {
  double listening_s = 3;  // answers of zero force: somebody moves and turns the tool
  double felt_s = 2;       // force_n along +z, which comes and goes in kRamp_s
  double silent_s = 0.5;   // no answers
  double intruded_s = 1;   // right answers, and beside them some to poses of nobody, or of long ago
  double fault_s = 0.5;    // a latched fault
  double force_n = 0.3;

  double total_s() const { return listening_s + felt_s + silent_s + intruded_s + fault_s; }
};

/// Answers one tool's poses through all parts, and judges by their answer_seq which answers are exerted.
/// Time begins with the first pose. Reads no clock; one thread at a time.
class AnswerTrial {
 public:
  explicit AnswerTrial(const TrialTimes& times) : times_(times) {}

  /// What to send at once: nothing in the silence, two answers where an intruder speaks.
  std::vector<msg::ToolForce> take(const msg::ToolPose& pose, std::int64_t now_ns);
  bool over(std::int64_t now_ns) const { return part(now_ns) == Part::kOver; }
  /// `gap_s`: the device's own interval, by which it may be late.
  std::vector<Verdict> verdicts(double gap_s) const;

 private:
  enum class Part : std::uint8_t { kListening, kFelt, kSilent, kIntruded, kFault, kOver };
  struct Sent {
    std::uint64_t seq;
    std::int64_t at_ns;
  };

  double seconds(std::int64_t now_ns) const;
  double begin_s(Part part) const;
  Part part(std::int64_t now_ns) const;
  double force_n(std::int64_t now_ns) const;
  void judge(const msg::ToolPose& pose, std::int64_t now_ns);
  bool is_new(std::uint64_t answer_seq, std::int64_t now_ns) const;
  msg::ToolForce answer(const msg::ToolPose& pose, std::int64_t now_ns);
  std::optional<msg::ToolForce> intrusion(const msg::ToolPose& pose, std::int64_t now_ns);

  TrialTimes times_;
  std::int64_t first_ns_ = 0;
  std::uint64_t seq_ = 0, takes_ = 0;
  std::deque<Sent> sent_;                        // the newest second's
  std::deque<msg::ToolPose> answered_;           // the newest second's
  std::unordered_set<std::uint64_t> intruders_;  // numbers of what must not be exerted
  std::int64_t silent_since_ns_ = 0, let_go_ns_ = 0;
  std::uint64_t in_felt_ = 0, followed_ = 0, in_silence_ = 0, intruded_ = 0, in_fault_ = 0, held_ = 0;
  std::uint64_t fault_seq_ = 0;  // the first one that tells of the fault
};

}  // namespace omentum::session
