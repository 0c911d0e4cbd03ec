#include "node_common/energy_tank.h"

#include <algorithm>
#include <cmath>

namespace omentum::node {
namespace {

// A quick hand, m/s^2: from rest to 0.4 m/s in 20 ms, or a hand of 0.5 kg that lets 10 N push it. And
// rad/s^2: the same with the handle's end 5 cm from the tip, or the finger's 5 cm from the jaws' pivot.
constexpr double kQuickHand_m_s2 = 20;
constexpr double kQuickTurn_rad_s2 = 400;

// How much of the speed of a moment ago is left after one more look: a tenth after 22.
constexpr double kSpeedKept = 0.9;

double reach(double speed, double acceleration, double horizon_s) {
  return (speed + 0.5 * acceleration * horizon_s) * horizon_s;
}

}  // namespace

void HandMotion::follow(const Eigen::Vector3d& way, const Eigen::Vector3d& turn, double took_s,
                        double opened_rad) noexcept {
  steady = velocity.dot(way) > 0 ? std::min(steady + 1, EnergyTank::kSteadyWays) : 0;
  velocity = way / took_s;
  turn_rate = turn / took_s;
  grip_rate = opened_rad / took_s;
  speed = std::max(velocity.norm(), kSpeedKept * speed);
  turn_speed = std::max(turn_rate.norm(), kSpeedKept * turn_speed);
  grip_speed = std::max(std::abs(grip_rate), kSpeedKept * grip_speed);
}

double work_ahead_j(const Eigen::Vector3d& force, const Eigen::Vector3d& torque, const HandMotion& motion,
                    double horizon_s, double grip_torque_nm) noexcept {
  return force.norm() * reach(motion.speed, kQuickHand_m_s2, horizon_s) +
         torque.norm() * reach(motion.turn_speed, kQuickTurn_rad_s2, horizon_s) +
         std::abs(grip_torque_nm) * reach(motion.grip_speed, kQuickTurn_rad_s2, horizon_s);
}

void EnergyTank::observe(double given_j, double stored_j, double dt_s) noexcept {
  given_j_ += given_j;
  trial_j_ = std::clamp(trial_j_ - given_j + kTrial_w * dt_s, 0.0, kMostTrial_j);
  level_j_ = std::min(level_j_ - given_j, std::max(0.0, stored_j) + kReserve_j);
  // what the roof cut off before is the hand's own: it pays for the reserve
  const double owned_j = std::min(kReserve_j - given_j_, kReserve_j);
  if (level_j_ < owned_j) level_j_ = std::min(level_j_ + kRefill_w * dt_s, owned_j);
}

double EnergyTank::share(double ahead_j) const noexcept {
  if (ahead_j <= level_j_) return 1;
  return level_j_ > 0 ? level_j_ / ahead_j : 0;
}

Eigen::Vector3d EnergyTank::damping(const HandMotion& motion, double interval_s) const noexcept {
  const double missing_j = kLow_j - level_j_, speed = motion.velocity.norm();
  if (missing_j <= 0 || motion.steady < kSteadyWays || !(interval_s > 0)) return Eigen::Vector3d::Zero();
  const double wanted =
      std::clamp(kMaxDamping_n_s_m * missing_j / kFullDamping_j, kLeastDamping_n_s_m, kMaxDamping_n_s_m);
  const double risk_j = std::max(kDamperRisk * (kBound_j - kDamperMargin_j - given_j_), trial_j_);
  const double ahead_m = reach(motion.speed, kQuickHand_m_s2, 2 * interval_s);
  const double most_n = std::min(risk_j / ahead_m, kMostDamping_n);
  return -std::min({wanted, kLightHandle_kg / interval_s, most_n / speed}) * motion.velocity;
}

}  // namespace omentum::node
