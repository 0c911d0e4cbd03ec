#include "physics/intestine/gut_system.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omentum::physics {

using geometry::MassId;
using geometry::Vec3;

namespace {

// Of any mass, and of the whole gut: no load of a hand or a fall brings them near that.
constexpr double kWildSpeed_m_s = 100;

GutStepSettings checked(const GutStepSettings& settings) {
  if (!(std::isfinite(settings.step_s) && settings.step_s > 0)) {
    throw std::invalid_argument("step_s: expected a number above 0");
  }
  if (settings.iterations < 1) throw std::invalid_argument("iterations: expected 1 or more");
  if (!settings.gravity_m_s2.allFinite()) throw std::invalid_argument("gravity_m_s2: expected numbers");
  return settings;
}

// The diagonal of A^-1 for all masses; 0 where held.
std::vector<double> inverse_diagonal(const GutBand& band, std::size_t masses) {
  const std::vector<double> of_free = band.diagonal_of_inverse();
  std::vector<double> yields(masses, 0.0);
  for (std::size_t place = 0; place < of_free.size(); ++place)
    yields[static_cast<std::size_t>(band.mass(place))] = of_free[place];
  return yields;
}

}  // namespace

GutSystem::GutSystem(const geometry::GutShape& shape, const GutMaterial& material,
                     const GutCollisionSettings& collisions, const GutStepSettings& step)
    : shape_(shape),
      settings_(checked(step)),
      springs_(shape, material),
      band_(springs_, step.step_s),
      collisions_(shape, springs_.mass(), step.step_s, collisions),
      energies_(springs_),
      own_yields_(inverse_diagonal(band_, springs_.mass().size())),
      x_(springs_.mass().size()),
      forces_(springs_.mass().size()),
      yield_(band_.size()) {
  if (step.method == GutMethod::kExplicit) explicit_.emplace(springs_, step.step_s);
  if (step.method == GutMethod::kProjective)
    projective_.emplace(springs_, band_, step.step_s, step.iterations);
  for (const double m : springs_.mass()) wild_j_ += 0.5 * m * kWildSpeed_m_s * kWildSpeed_m_s;
  reset();
  before_ = state_.x;
  carried_ = state_.v;
}

void GutSystem::reset() noexcept {
  state_.x = shape_.positions;
  state_.v.assign(shape_.positions.size(), Vec3::Zero());
  collisions_.reset();
  report_ = {};
}

void GutSystem::take_up(const GutSystem& other) noexcept {
  collisions_.take_up(other.collisions_);
  state_ = other.state_;
  report_ = {};
}

void GutSystem::move_to(const GutState& wanted, const GutLoads& loads) noexcept {
  if (report_.diverged) return;
  before_ = state_.x;
  carried_ = state_.v;
  state_ = wanted;
  collisions_.resolve(before_, state_, loads.obstacles, {}, nullptr, carried_);
  observe();
}

void GutSystem::step(const GutLoads& loads) noexcept {
  if (report_.diverged) return;
  before_ = state_.x;
  gather_forces(loads.forces_n);
  is_wild_ = false;
  if (explicit_) {
    explicit_->step(forces_, state_);
    watch(state_.v);
  }
  if (projective_) projective_->begin(forces_, state_);
  collisions_.resolve(before_, state_, loads.obstacles, loads.spheres, projective_ ? this : nullptr);
  observe();
  report_.diverged |= is_wild_;
}

// Before the bound of the collisions hides it.
void GutSystem::watch(std::span<const Vec3> v) noexcept {
  is_wild_ = !std::ranges::all_of(
      v, [](const Vec3& speed) { return speed.squaredNorm() < kWildSpeed_m_s * kWildSpeed_m_s; });
}

void GutSystem::go_downhill(std::span<const Vec3> pushes_n, std::span<Vec3> x) noexcept {
  projective_->go_downhill(pushes_n, x);
}

void GutSystem::end_step(std::span<const Vec3> pushes_n, std::span<const Vec3> x,
                         std::span<Vec3> v) noexcept {
  projective_->end(pushes_n, x, v);
  watch(v);
}

void GutSystem::gather_forces(std::span<const Vec3> forces_n) noexcept {
  geometry::require(forces_n.empty() || forces_n.size() == forces_.size(), "a force for each mass, or none");
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    forces_[i] = springs_.mass()[i] * settings_.gravity_m_s2;
    if (!forces_n.empty()) forces_[i] += forces_n[i];
  }
}

void GutSystem::observe() noexcept {
  report_.collisions = collisions_.report();
  report_.kinetic_j = kinetic_energy(springs_, state_.v);
  x_.take(state_.x);
  report_.elastic_j = energies_.measure(x_);
  report_.diverged = !(report_.kinetic_j + report_.elastic_j < wild_j_);
}

void GutSystem::compliance(std::span<const MassId> masses, std::span<double> block) const noexcept {
  const std::size_t n = masses.size();
  geometry::require(block.size() == n * n, "an entry for each pair of masses");
  const auto held = [this](MassId m) { return springs_.layout().is_held(m); };
  for (std::size_t j = 0; j < n; ++j) {
    std::fill(yield_.begin(), yield_.end(), GutBand::Node{});
    if (!held(masses[j])) yield_[band_.place(masses[j])].v[0] = 1;
    band_.solve(yield_.data());
    for (std::size_t i = 0; i < n; ++i)
      block[i * n + j] = held(masses[i]) ? 0 : yield_[band_.place(masses[i])].v[0];
  }
}

void GutSystem::yield_to(std::span<const Vec3> forces_n, std::span<Vec3> yield_m) const noexcept {
  geometry::require(forces_n.size() == forces_.size() && yield_m.size() == forces_.size(),
                    "a value for each mass");
  const std::span<const MassId> masses = band_.masses();
  for (std::size_t place = 0; place < yield_.size(); ++place) {
    const Vec3& f = forces_n[masses[place]];
    yield_[place] = {{f.x(), f.y(), f.z(), 0}};
  }
  band_.solve(yield_.data());
  std::fill(yield_m.begin(), yield_m.end(), Vec3::Zero());
  for (std::size_t place = 0; place < yield_.size(); ++place) {
    yield_m[masses[place]] = Eigen::Map<const Vec3>(yield_[place].v);
  }
}

}  // namespace omentum::physics
