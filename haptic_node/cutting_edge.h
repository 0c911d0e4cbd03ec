// What a tool's cutting edge does, as contacts tell it.
#pragma once

#include "haptic_node/tool_kinematics.h"
#include "transport/messages.h"

#include <array>
#include <span>

namespace omentum::haptic {

/// One tool's cut, from tick to tick and from sample to sample (Contact in idl/contact.idl). The edge itself
/// exerts no force: a hook that burns parts what it meets, and the hand feels tissue by the tool's points
/// alone.
class CuttingEdge {
 public:
  /// `edge`: begin and end in T, m; empty: a tool that does not cut.
  explicit CuttingEdge(std::span<const Vec3> edge);

  /// Each tick. `engaged`: the tool is there, at `frame`; one that is gone ends its cut where it was last.
  void follow(const ToolFrame& frame, bool engaged, bool pressed) noexcept;

  bool cuts() const noexcept { return cuts_; }
  /// A cut has begun or ended since told().
  bool changed() const noexcept { return cuts_ != told_cuts_; }
  void fill(msg::Contact& contact) const noexcept;
  /// A sample left for each organ: the next one's way begins here.
  void told() noexcept;

 private:
  using Ends = std::array<Vec3, 2>;

  bool exists_;
  Ends in_tool_{Vec3::Zero(), Vec3::Zero()};
  bool cuts_ = false, told_cuts_ = false;
  std::uint64_t count_ = 0;
  Ends before_ = in_tool_, now_ = in_tool_;
};

}  // namespace omentum::haptic
