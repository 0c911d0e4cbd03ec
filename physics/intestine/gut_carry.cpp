#include "physics/intestine/gut_carry.h"

#include "physics/intestine/gut_parts.h"

#include <algorithm>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Of the response in each iteration. Contacts go on from step to step, so few suffice.
constexpr std::int32_t kPasses = 1;
// Of all that contacts push: what they would change by less they leave to a later iteration.
constexpr double kSettled = 1e-4;

// J x of a contact: the way of its first point from its second.
Vec3 between(const GutContact& contact, std::span<const Vec3> x) {
  return place_of(contact.one, x) - place_of(contact.other, x);
}

// How far a contact is open, m.
double open(const GutContact& contact, const Vec3& between) {
  const bool at_wall = !contact.other.mass[0].valid();
  return (between - (at_wall ? contact.place : Vec3(Vec3::Zero()))).dot(contact.normal) - contact.reach_m;
}

}  // namespace

GutCarry::GutCarry(std::int32_t masses, std::size_t all_masses, std::size_t most_contacts, double friction)
    : count_(static_cast<std::size_t>(masses)),
      response_(most_contacts, kPasses, friction),
      inverse_mass_(all_masses),
      aim_(all_masses),
      x_(all_masses),
      forces_(all_masses),
      change_(all_masses),
      yields_(all_masses) {
  eased_.reserve(most_contacts);
  way_.reserve(most_contacts);
}

void GutCarry::begin(std::span<const GutContact> contacts, const GutYield& yield, double step_s,
                     const MovingMasses& masses) noexcept {
  eased_.assign(contacts.begin(), contacts.end());
  for (GutContact& contact : eased_)
    contact.reach_m += std::min(0.0, open(contact, between(contact, masses.before)));
  std::ranges::copy(masses.inverse_mass, inverse_mass_.begin());
  const std::span<const double> own = yield.own_yields();
  for (std::size_t m = 0; m < count_; ++m) inverse_mass_[m] = own[m] / (step_s * step_s);
  response_.prepare(eased_, masses.before, inverse_mass_);
  std::ranges::copy(masses.x, aim_.begin());
  way_.resize(contacts.size());
}

void GutCarry::find_forces(std::span<const Vec3> pushes, double step_s,
                           std::span<Vec3> forces) const noexcept {
  std::ranges::fill(forces, Vec3::Zero());
  response_.add_pushes(pushes, step_s, forces);
}

void GutCarry::go_downhill(GutYield& yield, double step_s, const MovingMasses& masses) noexcept {
  yield.go_downhill(std::span(forces_).first(count_), masses.x.first(count_));
  for (std::size_t m = count_; m < masses.x.size(); ++m)
    masses.x[m] = aim_[m] + step_s * step_s * masses.inverse_mass[m] * forces_[m];
}

// Along way_, whose displacements are yields_.
double GutCarry::best_share(const MovingMasses& masses) const noexcept {
  const auto [gain, cost] = response_.look_along(way_, masses.x, yields_);
  return cost > 0 ? std::clamp(gain / cost, 0.0, 1.0) : 0;
}

// False where it is too short to matter.
bool GutCarry::find_way(std::span<const Vec3> pushes, double step_s, const MovingMasses& masses) noexcept {
  std::ranges::copy(masses.x, x_.begin());
  response_.part(pushes, step_s, x_);
  const auto [change_n_s, total_n_s] = response_.find_ways(pushes, step_s, way_);
  return change_n_s > kSettled * total_n_s;
}

void GutCarry::part(const GutYield& yield, double step_s, const MovingMasses& masses,
                    std::span<Vec3> pushes) noexcept {
  if (!find_way(pushes, step_s, masses)) return;
  find_forces(way_, step_s, change_);
  yield.yield_to(std::span(change_).first(count_), std::span(yields_).first(count_));
  for (std::size_t m = count_; m < masses.x.size(); ++m)
    yields_[m] = step_s * step_s * masses.inverse_mass[m] * change_[m];
  const double share = best_share(masses);
  for (std::size_t c = 0; c < pushes.size(); ++c) pushes[c] += share * way_[c];
  for (std::size_t m = 0; m < masses.x.size(); ++m) {
    masses.x[m] += share * yields_[m];
    forces_[m] += share * change_[m];
  }
}

void GutCarry::solve(std::span<const GutContact> contacts, GutYield& yield, double step_s,
                     const MovingMasses& masses, std::span<Vec3> pushes) noexcept {
  begin(contacts, yield, step_s, masses);
  find_forces(pushes, step_s, forces_);
  for (int k = 0; k < yield.iterations(); ++k) {
    go_downhill(yield, step_s, masses);
    if (!eased_.empty()) part(yield, step_s, masses, pushes);
  }
  yield.end_step(std::span(forces_).first(count_), masses.x.first(count_), masses.v.first(count_));
  for (std::size_t m = count_; m < masses.x.size(); ++m)
    masses.v[m] = (masses.x[m] - masses.before[m]) / step_s;
}

}  // namespace omentum::physics
