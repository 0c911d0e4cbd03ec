#include "physics/intestine/gut_carry.h"

#include <algorithm>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Rounds, and passes of the response in each. Contacts go on from step to step, so few suffice.
constexpr int kRounds = 2;
constexpr std::int32_t kPasses = 4;

Vec3 point_of(const GutPoint& point, std::span<const Vec3> of, std::size_t end) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) {
    if (static_cast<std::size_t>(point.mass[i]) < end) sum += point.weight[i] * of[point.mass[i]];
  }
  return sum;
}

// J x of a contact: the way of its first point from its second along the normal.
double along(const GutContact& contact, std::span<const Vec3> x) {
  return (point_of(contact.one, x, x.size()) - point_of(contact.other, x, x.size())).dot(contact.normal);
}

// How far a contact is open, m.
double open(const GutContact& contact, std::span<const Vec3> x) {
  const bool at_wall = !contact.other.mass[0].valid();
  return along(contact, x) - (at_wall ? contact.place.dot(contact.normal) : 0) - contact.reach_m;
}

}  // namespace

GutCarry::GutCarry(std::int32_t masses, std::size_t all_masses, std::size_t most_contacts)
    : count_(static_cast<std::size_t>(masses)),
      response_(most_contacts, kPasses, 0),
      inverse_mass_(all_masses),
      x_(all_masses),
      v_(all_masses),
      forces_(count_),
      yields_(count_) {
  eased_.reserve(most_contacts);
  way_.reserve(most_contacts);
}

void GutCarry::ease(std::span<const GutContact> contacts, const MovingMasses& masses) noexcept {
  eased_.assign(contacts.begin(), contacts.end());
  for (GutContact& contact : eased_) contact.reach_m += std::min(0.0, open(contact, masses.before));
}

void GutCarry::find_yields(std::span<const double> lambda, const GutYield& yield, double step_s) noexcept {
  std::ranges::fill(forces_, Vec3::Zero());
  const auto push = [&](const GutPoint& point, const Vec3& force) {
    for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) {
      if (static_cast<std::size_t>(point.mass[i]) < count_) forces_[point.mass[i]] += point.weight[i] * force;
    }
  };
  for (std::size_t c = 0; c < eased_.size(); ++c) {
    const Vec3 force = lambda[c] / step_s * eased_[c].normal;
    push(eased_[c].one, force);
    push(eased_[c].other, -force);
  }
  yield.yield_to(forces_, yields_);
}

void GutCarry::move(double share, double step_s, const MovingMasses& masses) const noexcept {
  for (std::size_t m = 0; m < count_; ++m) {
    masses.x[m] += share * yields_[m];
    masses.v[m] += share / step_s * yields_[m];
  }
}

// Along way_, whose displacements are yields_.
double GutCarry::best_share(double step_s, const MovingMasses& masses) const noexcept {
  double gain = 0, cost = 0;
  for (std::size_t c = 0; c < eased_.size(); ++c) {
    if (way_[c] == 0) continue;
    const double yielded =
        (point_of(eased_[c].one, yields_, count_) - point_of(eased_[c].other, yields_, count_))
            .dot(eased_[c].normal);
    gain -= way_[c] / step_s * open(eased_[c], masses.x);
    cost += way_[c] / step_s * yielded;
  }
  return cost > 0 ? std::clamp(gain / cost, 0.0, 1.0) : 0;
}

void GutCarry::solve(std::span<const GutContact> contacts, const GutYield& yield, double step_s,
                     const MovingMasses& masses, std::span<double> lambda) noexcept {
  ease(contacts, masses);
  const std::span<const double> own = yield.own_yields();
  for (std::size_t m = 0; m < count_; ++m) inverse_mass_[m] = own[m] / (step_s * step_s);
  find_yields(lambda, yield, step_s);
  move(1, step_s, masses);
  for (int round = 0; round < kRounds; ++round) {
    std::ranges::copy(masses.x, x_.begin());
    std::ranges::copy(masses.v, v_.begin());
    const std::size_t all = masses.x.size();
    response_.solve(eased_, lambda, step_s,
                    {masses.before, std::span(x_).first(all), std::span(v_).first(all), inverse_mass_});
    way_.resize(lambda.size());
    for (std::size_t c = 0; c < lambda.size(); ++c) way_[c] = response_.shift(c) / step_s - lambda[c];
    find_yields(way_, yield, step_s);
    const double share = best_share(step_s, masses);
    for (std::size_t c = 0; c < lambda.size(); ++c) lambda[c] += share * way_[c];
    move(share, step_s, masses);
  }
}

}  // namespace omentum::physics
