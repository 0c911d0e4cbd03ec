#include "session_tools/answer_trial.h"

#include <algorithm>

namespace omentum::session {

namespace {

constexpr double kRamp_s = 0.2;
constexpr double kValidFor_s = 0.02;
constexpr double kDecay_s = 0.02;      // a force that nothing renews is gone within it
constexpr double kGrace_s = 0.015;     // of an ordinary system's timers
constexpr double kOldAnswer_s = 0.05;  // to a pose from before it, an answer must not be exerted
constexpr double kKept_s = 1;
constexpr double kFollowed = 0.95;  // of all poses, on a link that loses some
// another device's pose: a number and a time of its own
constexpr std::uint64_t kNobodysPose = 1'000'000'007;
constexpr std::int64_t kNobodysStamp_ns = 1'234'567;
constexpr int kIntrusionEvery = 10;  // poses

double between_s(std::int64_t begin_ns, std::int64_t end_ns) {
  return 1e-9 * static_cast<double>(end_ns - begin_ns);
}

double share(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

double AnswerTrial::seconds(std::int64_t now_ns) const {
  return first_ns_ == 0 ? 0 : between_s(first_ns_, now_ns);
}

double AnswerTrial::begin_s(Part part) const {
  const double lengths[] = {times_.listening_s, times_.felt_s, times_.silent_s, times_.intruded_s,
                            times_.fault_s};
  double begin = 0;
  for (std::size_t before = 0; before < static_cast<std::size_t>(part); ++before) begin += lengths[before];
  return begin;
}

AnswerTrial::Part AnswerTrial::part(std::int64_t now_ns) const {
  const double now_s = seconds(now_ns);
  for (const Part part : {Part::kFelt, Part::kSilent, Part::kIntruded, Part::kFault, Part::kOver})
    if (now_s < begin_s(part)) return static_cast<Part>(static_cast<std::uint8_t>(part) - 1);
  return Part::kOver;
}

// rises slowly, so that no hand is hit, and stays: the silence then has a force to let go of
double AnswerTrial::force_n(std::int64_t now_ns) const {
  if (part(now_ns) != Part::kFelt) return 0;
  return times_.force_n * std::min((seconds(now_ns) - begin_s(Part::kFelt)) / kRamp_s, 1.0);
}

std::vector<msg::ToolForce> AnswerTrial::take(const msg::ToolPose& pose, std::int64_t now_ns) {
  if (first_ns_ == 0) first_ns_ = now_ns;
  judge(pose, now_ns);
  const Part now = part(now_ns);
  if (now == Part::kOver) return {};
  if (now == Part::kSilent) {
    if (silent_since_ns_ == 0) silent_since_ns_ = sent_.empty() ? now_ns : sent_.back().at_ns;
    return {};
  }
  std::vector<msg::ToolForce> answers{answer(pose, now_ns)};
  if (now == Part::kIntruded)
    if (const auto intruder = intrusion(pose, now_ns)) answers.push_back(*intruder);
  answered_.push_back(pose);
  while (answered_.size() > 1 && between_s(answered_[1].stamp_ns, pose.stamp_ns) > kKept_s)
    answered_.pop_front();
  return answers;
}

msg::ToolForce AnswerTrial::answer(const msg::ToolPose& pose, std::int64_t now_ns) {
  msg::ToolForce answer{.tool = pose.tool,
                        .seq = ++seq_,
                        .tick = seq_,
                        .echo_seq = pose.seq,
                        .echo_stamp_ns = pose.stamp_ns,
                        .force = {0, 0, force_n(now_ns)},
                        .valid_for_s = kValidFor_s};
  if (part(now_ns) == Part::kFault) {
    answer.state = msg::FORCE_FAULT;
    if (fault_seq_ == 0) fault_seq_ = seq_;
  }
  sent_.push_back({seq_, now_ns});
  while (between_s(sent_.front().at_ns, now_ns) > kKept_s) sent_.pop_front();
  return answer;
}

// in turn to a pose that nobody sent, and to one from too long ago
std::optional<msg::ToolForce> AnswerTrial::intrusion(const msg::ToolPose& pose, std::int64_t now_ns) {
  if (++takes_ % kIntrusionEvery != 0) return std::nullopt;
  msg::ToolForce intruder = answer(pose, now_ns);
  const msg::ToolPose& old = answered_.front();
  const bool is_old = between_s(old.stamp_ns, pose.stamp_ns) > 2 * kOldAnswer_s;
  if (takes_ / kIntrusionEvery % 2 == 0 && is_old) {
    intruder.echo_seq = old.seq;
    intruder.echo_stamp_ns = old.stamp_ns;
  } else {
    intruder.echo_seq = pose.seq + kNobodysPose;
    intruder.echo_stamp_ns = pose.stamp_ns - kNobodysStamp_ns;
  }
  sent_.pop_back();
  intruders_.insert(intruder.seq);
  return intruder;
}

bool AnswerTrial::is_new(std::uint64_t answer_seq, std::int64_t now_ns) const {
  const auto sent =
      std::find_if(sent_.rbegin(), sent_.rend(), [&](const Sent& one) { return one.seq == answer_seq; });
  return sent != sent_.rend() && between_s(sent->at_ns, now_ns) <= kOldAnswer_s;
}

void AnswerTrial::judge(const msg::ToolPose& pose, std::int64_t now_ns) {
  intruded_ += intruders_.contains(pose.answer_seq);
  const Part now = part(now_ns);
  const double since_s = seconds(now_ns) - begin_s(now);
  if (now == Part::kFelt && since_s > kRamp_s) {
    ++in_felt_;
    followed_ += is_new(pose.answer_seq, now_ns);
  }
  if (now == Part::kSilent) {
    ++in_silence_;
    if (pose.answer_seq != 0) let_go_ns_ = now_ns;
  }
  if (now == Part::kFault && since_s > kValidFor_s + kDecay_s + kGrace_s) {
    ++in_fault_;
    held_ += pose.answer_seq != 0 && pose.answer_seq < fault_seq_;
  }
}

std::vector<Verdict> AnswerTrial::verdicts(double gap_s) const {
  const double allowed_s = kValidFor_s + kDecay_s + kGrace_s + 2 * gap_s;
  const double held_s = let_go_ns_ == 0 ? 0 : between_s(silent_since_ns_, let_go_ns_);
  return {verdict("answers are exerted", share(followed_, in_felt_) >= kFollowed,
                  text("%.0f %% of the poses are under an answer of the last %.0f ms (expected %.0f %%)",
                       100 * share(followed_, in_felt_), 1e3 * kOldAnswer_s, 100 * kFollowed)),
          verdict("without answers it lets go, and poses go on", in_silence_ > 0 && held_s <= allowed_s,
                  in_silence_ == 0
                      ? "no pose came in the silence"
                      : text("after %.0f ms (expected at most %.0f)", 1e3 * held_s, 1e3 * allowed_s)),
          verdict("other devices' and late answers are refused", !intruders_.empty() && intruded_ == 0,
                  text("%llu poses under one of %zu such answers", static_cast<unsigned long long>(intruded_),
                       intruders_.size())),
          verdict("a latched fault ends the force before it, and poses go on", in_fault_ > 0 && held_ == 0,
                  in_fault_ == 0 ? "no pose came during the fault"
                                 : text("%llu of %llu poses still under an older answer",
                                        static_cast<unsigned long long>(held_),
                                        static_cast<unsigned long long>(in_fault_)))};
}

}  // namespace omentum::session
