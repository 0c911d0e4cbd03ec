#include "physics/intestine/gut_response.h"

#include <algorithm>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Of the sum w^2 / m: below, nothing of a contact can give way (1/kg).
constexpr double kNoYield = 1e-12;

template <class Row>
Vec3 weighted(const Row& row, std::span<const Vec3> of) {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = 0; i < row.count; ++i) sum += row.weight[i] * of[row.mass[i]];
  return sum;
}

template <class Row>
void add(const Row& row, const Vec3& impulse, std::span<Vec3> to) {
  for (std::int32_t i = 0; i < row.count; ++i) to[row.mass[i]] += row.yield[i] * impulse;
}

// What of a wish stays within a disc around 0.
Vec3 within(const Vec3& wish, double radius) {
  const double length = wish.norm();
  return length > radius ? Vec3(wish * (radius / length)) : wish;
}

}  // namespace

GutResponse::GutResponse(std::size_t most_contacts, std::int32_t passes, double friction)
    : passes_(passes), friction_(friction) {
  rows_.reserve(most_contacts);
}

GutResponse::Row GutResponse::prepared(const GutContact& contact, const MovingMasses& masses) const noexcept {
  Row row;
  double D = 0;
  const auto take = [&](const GutPoint& point, double sign) {
    for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) {
      const auto k = static_cast<std::size_t>(row.count++);
      row.mass[k] = point.mass[i];
      row.weight[k] = sign * point.weight[i];
      row.yield[k] = row.weight[k] * masses.inverse_mass[point.mass[i]];
      D += row.weight[k] * row.yield[k];
    }
  };
  take(contact.one, 1);
  take(contact.other, -1);
  row.normal = contact.normal;
  row.per_D = D > kNoYield ? 1 / D : 0;
  const bool at_wall = !contact.other.mass[0].valid();
  row.offset = contact.reach_m + (at_wall ? contact.place.dot(contact.normal) : 0);
  row.wall_velocity = contact.velocity;
  row.rubbed_way = row.rubbed_speed = Vec3::Zero();
  return row;
}

void GutResponse::correct(Row& row, const MovingMasses& masses) const noexcept {
  const double open = weighted(row, masses.x).dot(row.normal) - row.offset;
  const double g = std::max(0.0, row.g - open * row.per_D);
  if (g != row.g) add(row, (g - row.g) * row.normal, masses.x);
  row.g = g;
  if (g <= 0 && row.f <= 0) return;
  const double speed = (weighted(row, masses.v) - row.wall_velocity).dot(row.normal);
  const double f = std::max(0.0, row.f - speed * row.per_D);
  if (f != row.f) add(row, (f - row.f) * row.normal, masses.v);
  row.f = f;
}

void GutResponse::rub(Row& row, const MovingMasses& masses) const noexcept {
  if (row.g <= 0 && row.f <= 0) return;
  const auto along = [&](const Vec3& way) -> Vec3 { return way - way.dot(row.normal) * row.normal; };
  const Vec3 way = along(weighted(row, masses.x) - weighted(row, masses.before));
  const Vec3 taken = within(row.rubbed_way - way * row.per_D, friction_ * row.g);
  add(row, taken - row.rubbed_way, masses.x);
  row.rubbed_way = taken;
  const Vec3 speed = along(weighted(row, masses.v) - row.wall_velocity);
  const Vec3 given = within(row.rubbed_speed - speed * row.per_D, friction_ * row.f);
  add(row, given - row.rubbed_speed, masses.v);
  row.rubbed_speed = given;
}

void GutResponse::solve(std::span<const GutContact> contacts, std::span<const double> warm, double step_s,
                        const MovingMasses& masses) noexcept {
  rows_.clear();
  for (std::size_t c = 0; c < std::min(contacts.size(), rows_.capacity()); ++c) {
    rows_.push_back(prepared(contacts[c], masses));
    if (warm.empty()) continue;
    rows_.back().f = warm[c];
    rows_.back().g = warm[c] * step_s;
  }
  for (std::int32_t pass = 0; pass < passes_; ++pass) {
    for (Row& row : rows_) {
      correct(row, masses);
      if (friction_ > 0) rub(row, masses);
    }
  }
}

Vec3 GutResponse::impulse(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].f * rows_[contact].normal + rows_[contact].rubbed_speed;
}

std::int32_t GutResponse::pushing() const noexcept {
  return static_cast<std::int32_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.g > 0 || row.f > 0; }));
}

double GutResponse::deepest_m(const MovingMasses& masses) const noexcept {
  double deepest = 0;
  for (const Row& row : rows_) {
    if (row.per_D > 0) deepest = std::max(deepest, row.offset - weighted(row, masses.x).dot(row.normal));
  }
  return deepest;
}

}  // namespace omentum::physics
