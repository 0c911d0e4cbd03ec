#include "physics/dynamics/energy_watch.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

constexpr double kWriteOff_s = 1;  // slower than any swing of an organ, faster than a person watches
constexpr double kDampedMargin = 4;
constexpr double kRoom = 2;  // for several modes at once, and for cuts at an unlucky moment

}  // namespace

void EnergyWatch::restart(double energy_j) noexcept {
  account_j_ = peak_j_ = energy_j;
}

void EnergyWatch::add_work(double work_j) noexcept {
  account_j_ += work_j;
  peak_j_ = std::max(peak_j_, account_j_);
}

bool EnergyWatch::accepts(double energy_j, double elapsed_s) noexcept {
  if (!(energy_j <= margin_ * peak_j_ + slack_j_)) return false;
  const double kept = std::exp(-elapsed_s / kWriteOff_s);
  // only downwards: energy above the account is not acknowledged by being there
  account_j_ = std::max(0.0, std::min(account_j_, energy_j + kept * (account_j_ - energy_j)));
  peak_j_ = account_j_ + kept * (peak_j_ - account_j_);
  return true;
}

double energy_margin(ExplicitScheme scheme, double share) {
  if (scheme != ExplicitScheme::kSymplecticEuler) return kDampedMargin;
  return kRoom * (1 + share) / (1 - share);
}

}  // namespace omentum::physics
