// What a device says of itself and of its tool, against what it owes (docs/devices.md).
#pragma once

#include "session_tools/motion_agreement.h"
#include "session_tools/verdict.h"
#include "transport/messages.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace omentum::session {

/// One tool's poses in order of arrival. Reads no clock; one thread at a time.
class PoseRecord {
 public:
  void take(const msg::DeviceInfo& info) { info_ = info; }
  void take(const msg::ToolPose& pose, std::int64_t arrival_ns);
  /// Something that it writes is not heard: the topic, and what it should offer.
  void refuse(const std::string& topic, const std::string& what_to_offer);

  const std::optional<msg::DeviceInfo>& info() const { return info_; }
  std::uint64_t poses() const { return poses_; }
  bool refused() const { return !refused_.empty(); }
  std::int64_t newest_ns() const { return arrival_ns_; }  // arrival
  /// Between two poses, s; 0 before the second one.
  double median_gap_s() const;

  std::vector<Verdict> verdicts() const;
  /// The one that can be judged though no pose came.
  Verdict offered() const;

 private:
  void watch_form(const msg::ToolPose& pose);
  void watch_order(const msg::ToolPose& pose, std::int64_t arrival_ns);

  Verdict described() const;
  Verdict often() const;
  Verdict evenly() const;
  Verdict numbered() const;
  Verdict stamped() const;
  Verdict well_formed() const;
  Verdict within_workspace() const;

  std::optional<msg::DeviceInfo> info_;
  std::string refused_;  // what is not heard, and why
  std::optional<msg::ToolPose> newest_;
  std::int64_t first_ns_ = 0, arrival_ns_ = 0, first_stamp_ns_ = 0;
  std::vector<double> gaps_s_;
  std::uint64_t poses_ = 0, invalid_ = 0, not_finite_ = 0, not_unit_ = 0, outside_ = 0;
  std::uint64_t backwards_ = 0, lost_ = 0, stamps_back_ = 0;
  MotionWatch motion_;
};

}  // namespace omentum::session
