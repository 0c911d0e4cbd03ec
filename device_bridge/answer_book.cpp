#include "device_bridge/answer_book.h"

namespace omentum::device {

void AnswerBook::serve(std::uint32_t tool) {
  const std::lock_guard lock(mutex_);
  tools_.at(tool).served = true;
}

void AnswerBook::add(const msg::ToolForce& answer, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (answer.tool >= tools_.size() || !tools_[answer.tool].served) return;
  Tool& tool = tools_[answer.tool];
  // a node without a new pose answers the last one again
  if (answer.echo_seq > tool.echo_seq) {
    if (tool.echo_seq > 0) unanswered_ += answer.echo_seq - tool.echo_seq - 1;
    tool.echo_seq = answer.echo_seq;
  }
  add(kForce, answer.tool, answer.echo_stamp_ns, now_ns);
}

void AnswerBook::add(const msg::NodeStatus& status, std::int64_t now_ns) {
  if (status.kind != msg::NODE_DEFORM && status.kind != msg::NODE_RENDER) return;
  const std::lock_guard lock(mutex_);
  const Kind kind = status.kind == msg::NODE_DEFORM ? kOrgan : kPicture;
  for (const msg::Echo& echo : status.echoes) add(kind, echo.tool, echo.stamp_ns, now_ns);
}

void AnswerBook::add(Kind kind, std::uint32_t tool, std::int64_t stamp_ns, std::int64_t now_ns) {
  if (tool >= tools_.size() || !tools_[tool].served) return;
  if (stamp_ns < begin_ns_ || stamp_ns > now_ns || stamp_ns <= tools_[tool].newest_ns[kind]) return;
  tools_[tool].newest_ns[kind] = stamp_ns;
  latency_[kind].add_ns(now_ns - stamp_ns);
}

AnswerReport AnswerBook::report() const {
  const std::lock_guard lock(mutex_);
  return {latency_[kForce].percentiles(), latency_[kOrgan].percentiles(), latency_[kPicture].percentiles(),
          unanswered_};
}

}  // namespace omentum::device
