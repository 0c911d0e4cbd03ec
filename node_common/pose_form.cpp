#include "node_common/pose_form.h"

#include <cmath>

namespace omentum::node {
namespace {

// A quaternion off by this has gone through more than rounding and normalizing.
constexpr double kUnitTolerance = 1e-3;

bool finite(const msg::Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const msg::ToolPose& pose) {
  const msg::Quat& q = pose.orientation;
  return finite(pose.position) && finite(pose.linear_velocity) && finite(pose.angular_velocity) &&
         std::isfinite(pose.grip) && std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) &&
         std::isfinite(q.z);
}

}  // namespace

PoseForm form_of(const msg::ToolPose& pose) noexcept {
  if (!pose.valid) return PoseForm::kInvalid;
  if (!finite(pose)) return PoseForm::kNotFinite;
  const msg::Quat& q = pose.orientation;
  const double length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
  return std::abs(length - 1) > kUnitTolerance ? PoseForm::kNotARotation : PoseForm::kWell;
}

}  // namespace omentum::node
