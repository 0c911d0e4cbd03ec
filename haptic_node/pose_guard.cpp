#include "haptic_node/pose_guard.h"

#include "node_common/pose_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::haptic {
namespace {

// Noise that any tracker may have between two samples, m and rad.
constexpr double kPlaceNoise_m = 1e-3;
constexpr double kTurnNoise_rad = 0.02;

double distance(const msg::Vec3& a, const msg::Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

double angle_between(const msg::Quat& a, const msg::Quat& b) {
  const double cos_half = std::abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z);
  return 2 * std::acos(std::min(1.0, cos_half));
}

}  // namespace

const char* describe(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::kAccepted:
      return "accepted";
    case PoseVerdict::kReconnected:
      return "new connection";
    case PoseVerdict::kInvalid:
      return "marked invalid";
    case PoseVerdict::kSameMeasurement:
      return "not measured anew";
    case PoseVerdict::kHandedOver:
      return "waits for the tool";
    case PoseVerdict::kNotFinite:
      return "not finite";
    case PoseVerdict::kNotARotation:
      return "orientation is no unit quaternion";
    case PoseVerdict::kOldSequence:
      return "repeated or older sequence number or stamp";
    case PoseVerdict::kJump:
      return "jumps farther than an instrument moves";
    case PoseVerdict::kForeign:
      return "the tool is another device's";
  }
  return "unknown";
}

std::int64_t stamp_difference_ns(std::int64_t earlier_ns, std::int64_t later_ns) noexcept {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(later_ns, earlier_ns, &difference)) return difference;
  return later_ns > earlier_ns ? std::numeric_limits<std::int64_t>::max()
                               : std::numeric_limits<std::int64_t>::min();
}

PoseVerdict PoseGuard::form(const msg::ToolPose& pose) noexcept {
  switch (node::form_of(pose)) {
    case node::PoseForm::kInvalid:
      return PoseVerdict::kInvalid;
    case node::PoseForm::kNotFinite:
      return PoseVerdict::kNotFinite;
    case node::PoseForm::kNotARotation:
      return PoseVerdict::kNotARotation;
    case node::PoseForm::kWell:
      break;
  }
  return PoseVerdict::kAccepted;
}

PoseVerdict PoseGuard::follows(const Sample& before, const msg::ToolPose& pose,
                               std::int64_t arrival_ns) noexcept {
  if (pose.seq <= before.pose.seq || pose.stamp_ns <= before.pose.stamp_ns) return PoseVerdict::kOldSequence;
  // a burst arrives faster than it was measured, a late one was measured faster than it arrives
  const std::int64_t measured_ns = stamp_difference_ns(before.pose.stamp_ns, pose.stamp_ns),
                     arrived_ns = arrival_ns - before.arrival_ns;
  const double gap_s = 1e-9 * std::clamp<std::int64_t>(std::max(measured_ns, arrived_ns), 0, kLongestGap_ns);
  if (distance(pose.position, before.pose.position) > kPlaceNoise_m + kMaxToolSpeed_m_s * gap_s ||
      angle_between(pose.orientation, before.pose.orientation) >
          kTurnNoise_rad + kMaxTurnSpeed_rad_s * gap_s) {
    return PoseVerdict::kJump;
  }
  return PoseVerdict::kAccepted;
}

PoseVerdict PoseGuard::accept(const msg::ToolPose& pose, std::int64_t arrival_ns,
                              PoseVerdict verdict) noexcept {
  if (verdict == PoseVerdict::kAccepted) lost_ += pose.seq - known_.pose.seq - 1;
  known_ = {true, pose, arrival_ns};
  candidate_.present = false;
  return verdict;
}

PoseVerdict PoseGuard::judge(const msg::ToolPose& pose, std::int64_t arrival_ns) noexcept {
  const PoseVerdict well_formed = form(pose);
  if (well_formed != PoseVerdict::kAccepted) return well_formed;
  if (!known_.present) return accept(pose, arrival_ns, PoseVerdict::kReconnected);
  if (pose.seq > known_.pose.seq && pose.stamp_ns == known_.pose.stamp_ns) {
    // it came, so that its number is not lost; what is known ages on
    lost_ += pose.seq - known_.pose.seq - 1;
    known_.pose.seq = pose.seq;
    return PoseVerdict::kSameMeasurement;
  }
  const PoseVerdict verdict = follows(known_, pose, arrival_ns);
  if (verdict == PoseVerdict::kAccepted) return accept(pose, arrival_ns, verdict);

  const bool continues = candidate_.present && is_accepted(follows(candidate_, pose, arrival_ns));
  if (!continues) candidate_since_ns_ = arrival_ns;
  candidate_ = {true, pose, arrival_ns};
  if (continues && arrival_ns - candidate_since_ns_ >= kReconnect_ns) {
    return accept(pose, arrival_ns, PoseVerdict::kReconnected);
  }
  return verdict;
}

}  // namespace omentum::haptic
