#include "node_common/tool_holder.h"

namespace omentum::node {

PoseRight ToolHolder::judge(const transport::ParticipantId& who, std::int64_t now_ns,
                            const KnownDevices& known) noexcept {
  if (who == holder_) return of_holder(now_ns, known);
  if (!known.wants(who) && known.another_wanted(who)) return PoseRight::kRefused;
  if (!holder_) return take(who, now_ns, known);
  const bool outranks = outranks_holder(who, known);
  if (next_ && next_->who != who) {
    const bool stays = known.wants(next_->who) || !known.wants(who);  // of two alike the first one
    if (stays && !is_gone(*next_, now_ns)) return PoseRight::kRefused;
    next_.reset();
  }
  if (!next_ || is_gone(*next_, now_ns)) next_ = {who, now_ns, now_ns};
  next_->heard_ns = now_ns;
  if (now_ns - next_->since_ns >= silence_ns_) return take(who, now_ns, known);
  return outranks ? PoseRight::kWaits : PoseRight::kRefused;
}

PoseRight ToolHolder::of_holder(std::int64_t now_ns, const KnownDevices& known) noexcept {
  // who was silent asks anew
  const bool may = known.wants(*holder_) || !known.another_wanted(*holder_);
  if (!may && now_ns - heard_ns_ >= silence_ns_) return PoseRight::kRefused;
  // an heir that is gone again inherits nothing
  if (next_ && !is_gone(*next_, now_ns) && outranks_holder(next_->who, known)) {
    heard_ns_ = now_ns;
    return PoseRight::kWaits;
  }
  // its name may come after its poses, and leave before the last of them
  if (const DeviceName name = known.name_of(*holder_); name[0] != 0) holder_name_ = name;
  return PoseRight::kHolds;
}

PoseRight ToolHolder::take(const transport::ParticipantId& who, std::int64_t now_ns,
                           const KnownDevices& known) noexcept {
  const DeviceName name = known.name_of(who);
  if (holder_) last_ = {last_.count + 1, now_ns, holder_name_, name};
  holder_ = who;
  holder_name_ = name;
  next_.reset();
  heard_ns_ = now_ns;
  return PoseRight::kTakes;
}

}  // namespace omentum::node
