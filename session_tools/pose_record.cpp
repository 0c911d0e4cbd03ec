#include "session_tools/pose_record.h"

#include "node_common/pose_form.h"

#include <algorithm>
#include <cmath>

namespace omentum::session {

namespace {

constexpr double kSlowest_hz = 40;   // below it every pose is stale before the next one comes
constexpr double kLongestGap = 2.5;  // of a device's own intervals: then its pose is stale
constexpr double kLateGaps = 0.01;   // of all: more are felt as a force that comes and goes
constexpr double kLostPoses = 0.05;  // of all, on a link that loses some
constexpr double kWorkspaceMargin_m = 0.01;
constexpr double kClockTolerance = 0.05;  // a clock of another unit is off by a thousand

// what a person does who was asked to move and to turn the tool
constexpr double kMoving_m_s = 0.005, kTurning_rad_s = 0.1;
constexpr double kAgreement = 0.7, kRatioLow = 0.5, kRatioHigh = 2;

bool finite(const msg::Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool within(const msg::Vec3& p, const msg::DeviceInfo& info) {
  const auto between = [](double low, double value, double high) {
    return value >= low - kWorkspaceMargin_m && value <= high + kWorkspaceMargin_m;
  };
  return between(info.workspace_min.x, p.x, info.workspace_max.x) &&
         between(info.workspace_min.y, p.y, info.workspace_max.y) &&
         between(info.workspace_min.z, p.z, info.workspace_max.z);
}

// "velocities", "m/s": what a device tells of its motion beside how its poses move
Verdict agrees(const char* requirement, const MotionAgreement& motion, double least, const char* unit,
               const char* what_to_do) {
  if (motion.speed() < least)
    return unseen(requirement, text("%.3f %s at most in the mean: %s", motion.speed(), unit, what_to_do));
  const bool passed =
      motion.agreement() >= kAgreement && motion.ratio() >= kRatioLow && motion.ratio() <= kRatioHigh;
  return verdict(requirement, passed,
                 text("agreement %.2f (expected at least %.1f; -1 is mirrored), told %.2f of what was seen",
                      motion.agreement(), kAgreement, motion.ratio()));
}

}  // namespace

void PoseRecord::refuse(const std::string& topic, const std::string& what_to_offer) {
  const std::string line = topic + ": " + what_to_offer;
  if (refused_.find(line) != std::string::npos) return;
  refused_ += (refused_.empty() ? "" : "; ") + line;
}

void PoseRecord::take(const msg::ToolPose& pose, std::int64_t arrival_ns) {
  watch_order(pose, arrival_ns);
  ++poses_;
  newest_ = pose;
  arrival_ns_ = arrival_ns;
  if (!pose.valid) {
    ++invalid_;
  } else {
    watch_form(pose);
  }
  motion_.take(pose);
}

void PoseRecord::watch_order(const msg::ToolPose& pose, std::int64_t arrival_ns) {
  if (!newest_) {
    first_ns_ = arrival_ns;
    first_stamp_ns_ = pose.stamp_ns;
    return;
  }
  gaps_s_.push_back(1e-9 * static_cast<double>(arrival_ns - arrival_ns_));
  if (pose.seq <= newest_->seq) {
    ++backwards_;
  } else {
    lost_ += pose.seq - newest_->seq - 1;
  }
  stamps_back_ += pose.stamp_ns < newest_->stamp_ns;
}

void PoseRecord::watch_form(const msg::ToolPose& pose) {
  const node::PoseForm form = node::form_of(pose);
  if (form == node::PoseForm::kNotFinite) {
    ++not_finite_;
    return;
  }
  not_unit_ += form == node::PoseForm::kNotARotation;
  outside_ += info_ && !within(pose.position, *info_);
}

double PoseRecord::median_gap_s() const {
  if (gaps_s_.empty()) return 0;
  std::vector<double> gaps = gaps_s_;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

std::vector<Verdict> PoseRecord::verdicts() const {
  return {
      offered(),
      described(),
      often(),
      evenly(),
      numbered(),
      stamped(),
      well_formed(),
      within_workspace(),
      agrees("velocity is that of the poses", motion_.linear(), kMoving_m_s, "m/s", "move the tool"),
      agrees("turning is that of the poses", motion_.angular(), kTurning_rad_s, "rad/s", "turn the tool")};
}

Verdict PoseRecord::offered() const {
  return verdict("its quality of service is enough to be heard", !refused(),
                 refused() ? refused_ : "no reader refused a writer");
}

Verdict PoseRecord::described() const {
  const std::string requirement = "device_info is told";
  if (!info_) return verdict(requirement, false, "none came");
  const msg::DeviceInfo& info = *info_;
  const bool limits = std::isfinite(info.max_force_n) && info.max_force_n > 0 &&
                      std::isfinite(info.max_torque_nm) && info.max_torque_nm >= 0 &&
                      info.max_stiffness_n_m > 0 && info.damping_n_s_m >= 0;
  const bool box = finite(info.workspace_min) && finite(info.workspace_max) &&
                   info.workspace_min.x < info.workspace_max.x &&
                   info.workspace_min.y < info.workspace_max.y && info.workspace_min.z < info.workspace_max.z;
  return verdict(requirement, limits && box,
                 text("\"%s\": %g N, %g N m%s%s", info.name.c_str(), info.max_force_n, info.max_torque_nm,
                      limits ? "" : "; expected finite limits above zero",
                      box ? "" : "; expected a workspace that is a box"));
}

Verdict PoseRecord::often() const {
  const double seconds = 1e-9 * static_cast<double>(arrival_ns_ - first_ns_);
  const double rate = seconds > 0 ? static_cast<double>(poses_ - 1) / seconds : 0;
  return verdict("poses come often enough", rate >= kSlowest_hz,
                 text("%.0f Hz (expected at least %.0f)", rate, kSlowest_hz));
}

Verdict PoseRecord::evenly() const {
  const double longest = kLongestGap * median_gap_s();
  const auto late = std::count_if(gaps_s_.begin(), gaps_s_.end(), [&](double gap) { return gap > longest; });
  const double share = gaps_s_.empty() ? 0 : static_cast<double>(late) / static_cast<double>(gaps_s_.size());
  return verdict("poses come evenly", share <= kLateGaps,
                 text("every %.2f ms; %.2f %% of them later than %.1f times that (expected at most %.0f %%)",
                      1e3 * median_gap_s(), 100 * share, kLongestGap, 100 * kLateGaps));
}

Verdict PoseRecord::numbered() const {
  const bool passed =
      backwards_ == 0 && static_cast<double>(lost_) <= kLostPoses * static_cast<double>(poses_);
  return verdict(
      "seq counts up by one", passed,
      text("%llu of %llu repeated or older, %llu left out", static_cast<unsigned long long>(backwards_),
           static_cast<unsigned long long>(poses_), static_cast<unsigned long long>(lost_)));
}

Verdict PoseRecord::stamped() const {
  const double seconds = static_cast<double>(arrival_ns_ - first_ns_);
  const double stamped = newest_ ? static_cast<double>(newest_->stamp_ns - first_stamp_ns_) : 0;
  const double ratio = seconds > 0 ? stamped / seconds : 0;
  return verdict("stamp_ns is a steady clock in ns",
                 stamps_back_ == 0 && std::abs(ratio - 1) <= kClockTolerance,
                 text("%llu ran backwards; it goes %.3g times as fast as ours",
                      static_cast<unsigned long long>(stamps_back_), ratio));
}

Verdict PoseRecord::well_formed() const {
  const std::string requirement = "valid poses are finite, quaternions unit";
  if (invalid_ == poses_) return unseen(requirement, "no pose was valid");
  return verdict(
      requirement, not_finite_ == 0 && not_unit_ == 0,
      text("%llu of %llu not finite, %llu not of length 1", static_cast<unsigned long long>(not_finite_),
           static_cast<unsigned long long>(poses_), static_cast<unsigned long long>(not_unit_)));
}

Verdict PoseRecord::within_workspace() const {
  const std::string requirement = "the tip is in the workspace";
  if (!info_ || invalid_ == poses_) return unseen(requirement, "no workspace, or no valid pose");
  return verdict(requirement, outside_ == 0,
                 text("%llu of %llu poses more than %.0f mm outside of device_info's box",
                      static_cast<unsigned long long>(outside_), static_cast<unsigned long long>(poses_),
                      1e3 * kWorkspaceMargin_m));
}

}  // namespace omentum::session
