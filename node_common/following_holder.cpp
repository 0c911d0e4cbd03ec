#include "node_common/following_holder.h"

#include <utility>

namespace omentum::node {

void FollowingHolder::answered(const msg::Echo& pose, std::int64_t now_ns,
                               const KnownDevices& known) noexcept {
  if (pose.seq == newest_.seq && pose.stamp_ns == newest_.stamp_ns) return;
  newest_ = pose;
  const std::optional<transport::ParticipantId> who = poses_.sender_of(pose);
  if (!who) return;
  unanswered_since_ns_.reset();
  if (who == holder_.holder()) return;
  holder_.give(*who, now_ns, known);
  begins_ = true;
}

PoseRight FollowingHolder::judge(const transport::ParticipantId& who, const msg::ToolPose& pose,
                                 std::int64_t now_ns, const KnownDevices& known) noexcept {
  poses_.heard(who, pose.seq, pose.stamp_ns);
  if (who == holder_.holder() && !may_go_on(now_ns, known)) return PoseRight::kRefused;
  const PoseRight right = holder_.judge(who, now_ns, known);
  if (right == PoseRight::kTakes) begins_ = false;
  if (right == PoseRight::kHolds && std::exchange(begins_, false)) return PoseRight::kTakes;
  return right;
}

// Whether the holder may go on.
bool FollowingHolder::may_go_on(std::int64_t now_ns, const KnownDevices& known) noexcept {
  const transport::ParticipantId& who = *holder_.holder();
  if (known.wants(who) || !known.another_wanted(who)) {
    unanswered_since_ns_.reset();
    return true;
  }
  if (!unanswered_since_ns_) unanswered_since_ns_ = now_ns;
  return now_ns - *unanswered_since_ns_ < kUnanswered_ns;
}

}  // namespace omentum::node
