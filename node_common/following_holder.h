// Whose poses move a tool, for a program that does not serve the hands.
#pragma once

#include "node_common/answered_poses.h"
#include "node_common/tool_holder.h"

namespace omentum::node {

/// Decides as haptic_node does (ToolHolder), and follows its answers where it decided otherwise: of two
/// devices that both go on sending, each program would for ever keep the one that it took, though a late
/// start, or poses that were lost on the way to it alone, made it take another one than the rest did.
///
/// What a tool's wanted device leaves to others while it rests is haptic_node's to say alone, since it
/// depends on who came first: one that it does not answer loses the tool. So programs that hear the same
/// poses and answers agree within kUnanswered_ns. Where no haptic_node is, each is as good as its own ears.
///
/// Plain arithmetic on given times; reads no clock. One thread at a time; allocates nothing.
class FollowingHolder {
 public:
  /// That long a tool stays with somebody who is not answered, beside a wanted one that rests: haptic_node
  /// forgets a silent device after as long.
  static constexpr std::int64_t kUnanswered_ns = 1'000'000'000;

  explicit FollowingHolder(std::int64_t silence_ns) : holder_(silence_ns) {}

  /// haptic_node's newest answer; one to the same pose as the last one says nothing new.
  void answered(const msg::Echo& pose, std::int64_t now_ns, const KnownDevices& known) noexcept;
  /// For a pose that is well formed. Says kTakes also of the first one of a hand that answers gave the tool.
  PoseRight judge(const transport::ParticipantId& who, const msg::ToolPose& pose, std::int64_t now_ns,
                  const KnownDevices& known) noexcept;
  /// The holder's pose was one that counts.
  void heard(std::int64_t now_ns) noexcept { holder_.heard(now_ns); }

  const std::optional<transport::ParticipantId>& holder() const noexcept { return holder_.holder(); }

 private:
  bool may_go_on(std::int64_t now_ns, const KnownDevices& known) noexcept;

  ToolHolder holder_;
  AnsweredPoses poses_;
  msg::Echo newest_{};
  std::optional<std::int64_t> unanswered_since_ns_;  // beside a wanted one that rests
  bool begins_ = false;  // answers gave the tool to somebody whose pose did not come yet
};

}  // namespace omentum::node
