#include "physics/intestine/contact_memory.h"

#include <algorithm>

namespace omentum::physics {

using geometry::Vec3;

namespace {

// Measured on guts that lie on a plane, 5 ms: from 0.5 to 0.8 they tremble least; nearer to 1 they swing.
constexpr double kShare = 0.6;

}  // namespace

ContactMemory::ContactMemory(const GutSprings& springs, double step_s, double reach_m)
    : springs_(springs),
      per_square_step_(1 / (step_s * step_s)),
      reach_m_(reach_m),
      forces_(springs),
      x_(springs.mass().size()),
      v_(springs.mass().size()),
      pressing_(springs.mass().size()),
      remembered_(springs.mass().size(), Vec3::Zero()) {}

void ContactMemory::learn(std::span<const Vec3> predicted, std::span<const Vec3> loads_n,
                          const GutState& state, std::span<const MovingSphere> spheres) noexcept {
  x_.take(state.x);
  v_.take(state.v);
  pressing_.take(loads_n);
  forces_.add_explicit(x_, v_, pressing_);
  for (std::size_t i = 0; i < remembered_.size(); ++i) {
    const Vec3 way = state.x[i] - predicted[i];
    if (way.isZero(0) && remembered_[i].isZero(0)) continue;
    const bool forgets = springs_.inverse_mass()[i] == 0 || is_near(spheres, state.x[i]);
    remembered_[i] = forgets ? Vec3::Zero() : blend(i, springs_.mass()[i] * per_square_step_ * way);
  }
}

Vec3 ContactMemory::blend(std::size_t mass, const Vec3& correction_n) const noexcept {
  const Vec3 all = kShare * remembered_[mass] + correction_n;
  const double most = pressing_.at(mass).norm(), size = all.norm();
  return size > most ? Vec3(all * (most / size)) : all;
}

bool ContactMemory::is_near(std::span<const MovingSphere> spheres, const Vec3& x) const noexcept {
  return std::any_of(spheres.begin(), spheres.end(), [&](const MovingSphere& sphere) {
    const double reach = sphere.radius_m + reach_m_;
    return (x - sphere.before).squaredNorm() < reach * reach ||
           (x - sphere.after).squaredNorm() < reach * reach;
  });
}

void ContactMemory::forget() noexcept {
  std::fill(remembered_.begin(), remembered_.end(), Vec3::Zero());
}

}  // namespace omentum::physics
