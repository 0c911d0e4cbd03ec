#include "node_common/tool_holder.h"

namespace omentum::node {

PoseRight ToolHolder::judge(const transport::ParticipantId& who, std::int64_t now_ns,
                            const KnownDevices& known) noexcept {
  if (who == holder_) return of_holder(now_ns, known);
  if (!known.wants(who) && known.another_wanted(who)) return PoseRight::kRefused;
  if (!holder_) return take(who, now_ns, known);
  return outranks_holder(who, known) ? of_heir(who, now_ns, known) : of_next(who, now_ns, known);
}

PoseRight ToolHolder::of_holder(std::int64_t now_ns, const KnownDevices& known) noexcept {
  // an heir that is gone again inherits nothing
  if (heir_ && heir_->handing_ns && !has_left(*heir_, now_ns) && outranks_holder(heir_->who, known)) {
    heard_ns_ = now_ns;
    return PoseRight::kWaits;
  }
  // its name may come after its poses, and leave before the last of them
  if (const DeviceName name = known.name_of(*holder_); name[0] != 0) holder_name_ = name;
  return PoseRight::kHolds;
}

PoseRight ToolHolder::of_heir(const transport::ParticipantId& who, std::int64_t now_ns,
                              const KnownDevices& known) noexcept {
  if (now_ns - heard_ns_ >= silence_ns_) return take(who, now_ns, known);
  const bool another = heir_ && heir_->who != who;
  if (another && known.wants(heir_->who) && !has_left(*heir_, now_ns)) return PoseRight::kRefused;
  const bool again = heir_ && !another && has_left(*heir_, now_ns);
  if (!heir_ || another || again) heir_ = Heir{{who, now_ns, now_ns}, {}};
  heir_->heard_ns = now_ns;
  if (!heir_->handing_ns && now_ns - heir_->since_ns >= silence_ns_) heir_->handing_ns = now_ns;
  if (heir_->handing_ns && now_ns - *heir_->handing_ns >= silence_ns_) return take(who, now_ns, known);
  return again ? PoseRight::kRefused : PoseRight::kWaits;
}

PoseRight ToolHolder::of_next(const transport::ParticipantId& who, std::int64_t now_ns,
                              const KnownDevices& known) noexcept {
  if (next_ && next_->who != who) {
    const bool stays = known.wants(next_->who) || !known.wants(who);  // of two alike the first one
    if (stays && now_ns - next_->heard_ns < silence_ns_) return PoseRight::kRefused;
    next_.reset();
  }
  if (!next_ || now_ns - next_->heard_ns >= silence_ns_) next_ = {who, now_ns, now_ns};
  next_->heard_ns = now_ns;
  return now_ns - next_->since_ns >= silence_ns_ ? take(who, now_ns, known) : PoseRight::kRefused;
}

PoseRight ToolHolder::take(const transport::ParticipantId& who, std::int64_t now_ns,
                           const KnownDevices& known) noexcept {
  const DeviceName name = known.name_of(who);
  if (holder_) last_ = {last_.count + 1, now_ns, holder_name_, name};
  holder_ = who;
  holder_name_ = name;
  next_.reset();
  heir_.reset();
  heard_ns_ = now_ns;
  return PoseRight::kTakes;
}

}  // namespace omentum::node
