// What every force on a hand keeps to, whatever came in.
#pragma once

#include "haptic_node/force_safety.h"
#include "transport/messages.h"

#include <algorithm>
#include <string>

namespace omentum::haptic_test {

/// How far `after` is from all that `before` can fall to, N: it keeps its direction as it falls.
inline double risen_n(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  const double squared = before.squaredNorm();
  const double kept = squared > 0 ? std::clamp(after.dot(before) / squared, 0.0, 1.0) : 0;
  return (after - kept * before).norm();
}

/// Looks at all forces of one tool. One thread at a time.
class ForceWatch {
 public:
  haptic::ForceLimits limits;

  void see(const msg::ToolForce& told) {
    const Eigen::Vector3d force(told.force.x, told.force.y, told.force.z);
    const Eigen::Vector3d torque(told.torque.x, told.torque.y, told.torque.z);
    if (!force.allFinite() || !torque.allFinite() || !std::isfinite(told.grip_torque))
      break_rule("is no number", told);
    if (force.norm() > limits.max_force_n + kRounding) break_rule("is above the limit", told);
    if (torque.norm() > limits.max_torque_nm + kRounding) break_rule("has a torque above the limit", told);
    if (told.seq == newest_.seq + 1) {
      const double ticks = static_cast<double>(told.tick - newest_.tick);
      if (risen_n(force_, force) > limits.max_slew_n_s * limits.period_s * ticks + kRounding)
        break_rule("stepped", told);
    }
    largest_n_ = std::max(largest_n_, force.norm());
    force_ = force;
    newest_ = told;
    ++seen_;
  }

  const std::string& broken() const { return broken_; }  // the first rule that was
  double largest_n() const { return largest_n_; }
  double newest_n() const { return force_.norm(); }
  const msg::ToolForce& newest() const { return newest_; }
  int seen() const { return seen_; }

 private:
  static constexpr double kRounding = 1e-9;

  void break_rule(const std::string& how, const msg::ToolForce& told) {
    if (broken_.empty())
      broken_ = "force " + std::to_string(told.seq) + " " + how + ": " + std::to_string(told.force.x) + ", " +
                std::to_string(told.force.y) + ", " + std::to_string(told.force.z) + " N";
  }

  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  msg::ToolForce newest_{};
  std::string broken_;
  double largest_n_ = 0;
  int seen_ = 0;
};

}  // namespace omentum::haptic_test
