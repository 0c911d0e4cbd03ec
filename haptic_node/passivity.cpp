#include "haptic_node/passivity.h"

#include <algorithm>

namespace omentum::haptic {

void PassivityObserver::observe(const Wrench& sent, const Vec3& way, const Vec3& turn, double stored_j,
                                double dt_s) noexcept {
  // exact for a device that holds its force between samples
  const double given = sent.force.dot(way) + sent.torque.dot(turn);
  given_j_ += given;
  const double roof = std::max(stored_j, 0.0) + kReserve_j;
  energy_j_ = std::clamp(energy_j_ - given, kFloor_j, roof);
  if (energy_j_ < kReserve_j) energy_j_ = std::min(energy_j_ + kRefill_w * dt_s, kReserve_j);
}

Vec3 PassivityObserver::damping(const Vec3& velocity, double interval_s) const noexcept {
  const double speed_squared = velocity.squaredNorm();
  if (energy_j_ >= 0 || !(speed_squared * interval_s > 0)) return Vec3::Zero();
  const double strongest = std::min(kMaxDamping_n_s_m, kLightHandle_kg / interval_s);
  return -std::min(-energy_j_ / (speed_squared * interval_s), strongest) * velocity;
}

double PassivityObserver::model_share() const noexcept {
  return std::clamp((kSilent_j + energy_j_) / (kSilent_j - kTolerated_j), 0.0, 1.0);
}

}  // namespace omentum::haptic
