#include "device_bridge/answer_gate.h"

#include <limits>

namespace omentum::device {
namespace {

// the stamp of no pose: whoever echoes it is late
constexpr std::int64_t kNeverSent_ns = std::numeric_limits<std::int64_t>::min();
constexpr auto kOldestPose_ns = static_cast<std::int64_t>(1e9 * AnswerGate::kOldestPose_s);

}  // namespace

AnswerCounts& AnswerCounts::operator+=(const AnswerCounts& other) {
  accepted += other.accepted;
  lost += other.lost;
  repeated += other.repeated;
  foreign += other.foreign;
  late += other.late;
  return *this;
}

void AnswerGaps::add_ours(std::uint64_t seq, bool restarted) noexcept {
  // behind what was followed: through another session's answers, which explain nothing
  if (begun_ && !restarted && seq > followed_) {
    const std::uint64_t missing = skipped_ + (seq - followed_ - 1);
    lost_.store(lost() + missing, std::memory_order_relaxed);
  }
  begun_ = true;
  followed_ = seq;
  skipped_ = 0;
}

void AnswerGaps::add_other(std::uint64_t seq) noexcept {
  if (!begun_ || seq <= followed_ || seq - followed_ > kSameSequence) return;
  skipped_ += seq - followed_ - 1;
  followed_ = seq;
}

AnswerGate::AnswerGate() noexcept {
  for (auto& stamp_ns : stamps_ns_) stamp_ns.store(kNeverSent_ns, std::memory_order_relaxed);
}

void AnswerGate::sent(std::uint64_t seq, std::int64_t stamp_ns) noexcept {
  stamps_ns_[seq % kPoses].store(stamp_ns, std::memory_order_relaxed);
}

AnswerVerdict AnswerGate::judge(const msg::ToolForce& answer, std::int64_t now_ns) noexcept {
  const AnswerVerdict found = verdict(answer, now_ns);
  counts_[static_cast<std::size_t>(found)].fetch_add(1, std::memory_order_relaxed);
  return found;
}

AnswerVerdict AnswerGate::verdict(const msg::ToolForce& answer, std::int64_t now_ns) noexcept {
  // before the memory is asked: it does not reach further back
  const bool late = answer.echo_stamp_ns < now_ns - kOldestPose_ns;
  const std::int64_t ours_ns = stamps_ns_[answer.echo_seq % kPoses].load(std::memory_order_relaxed);
  if (late || answer.echo_stamp_ns != ours_ns) {
    gaps_.add_other(answer.seq);
    return late ? AnswerVerdict::kLate : AnswerVerdict::kForeign;
  }
  const std::uint64_t restarts = sequence_.counters().restarts;
  if (!sequence_.accept(answer.seq, now_ns)) return AnswerVerdict::kRepeated;
  gaps_.add_ours(answer.seq, sequence_.counters().restarts > restarts);
  return AnswerVerdict::kAccepted;
}

AnswerCounts AnswerGate::counts() const noexcept {
  const auto count = [this](AnswerVerdict verdict) {
    return counts_[static_cast<std::size_t>(verdict)].load(std::memory_order_relaxed);
  };
  return {count(AnswerVerdict::kAccepted), gaps_.lost(), count(AnswerVerdict::kRepeated),
          count(AnswerVerdict::kForeign), count(AnswerVerdict::kLate)};
}

}  // namespace omentum::device
