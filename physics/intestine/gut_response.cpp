#include "physics/intestine/gut_response.h"

#include <algorithm>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Of the sum w^2 / m: below, nothing of a contact can give way (1/kg).
constexpr double kNoYield = 1e-12;
// Passes end where one moves no contact by more: far below what is seen or felt of a step.
constexpr double kStill_m = 1e-8, kStill_m_s = 1e-6;

template <class Row>
Vec3 weighted(const Row& row, std::span<const Vec3> of) {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = 0; i < row.count; ++i) sum += row.weight[i] * of[row.mass[i]];
  return sum;
}

// Whether that moved its points from each other by more than what counts as still.
template <class Row>
bool apply(const Row& row, const Vec3& impulse, double still, std::span<Vec3> to) {
  if (impulse.isZero(0)) return false;
  for (std::int32_t i = 0; i < row.count; ++i) to[row.mass[i]] += row.yield[i] * impulse;
  return impulse.squaredNorm() > still * still * row.per_D * row.per_D;
}

// What of a vector lies in the plane of a normal.
Vec3 across(const Vec3& vector, const Vec3& normal) {
  return vector - vector.dot(normal) * normal;
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

GutResponse::Row GutResponse::prepared(const GutContact& contact, std::span<const Vec3> before,
                                       std::span<const double> inverse_mass) const noexcept {
  Row row;
  double D = 0;
  const auto take = [&](const GutPoint& point, double sign) {
    for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) {
      const auto k = static_cast<std::size_t>(row.count++);
      row.mass[k] = point.mass[i];
      row.weight[k] = sign * point.weight[i];
      row.yield[k] = row.weight[k] * inverse_mass[point.mass[i]];
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
  row.before = weighted(row, before);
  return row;
}

// What pushes along the normal does not move along each other, and the other way round: both from one look.
bool GutResponse::correct_places(Row& row, std::span<Vec3> x) const noexcept {
  const Vec3 apart = weighted(row, x);
  const double g = std::max(0.0, row.g - (apart.dot(row.normal) - row.offset) * row.per_D);
  Vec3 change = (g - row.g) * row.normal;
  row.g = g;
  if (friction_ > 0 && (g > 0 || !row.rubbed_way.isZero())) {
    const Vec3 wish = row.rubbed_way - across(apart - row.before, row.normal) * row.per_D;
    const Vec3 rubbed = within(wish, friction_ * g);
    change += rubbed - row.rubbed_way;
    row.rubbed_way = rubbed;
  }
  return apply(row, change, kStill_m, x);
}

bool GutResponse::correct_speeds(Row& row, std::span<Vec3> v) const noexcept {
  if (row.g <= 0 && row.f <= 0 && row.rubbed_speed.isZero()) return false;
  const Vec3 apart = weighted(row, v) - row.wall_velocity;
  const double f = std::max(0.0, row.f - apart.dot(row.normal) * row.per_D);
  Vec3 change = (f - row.f) * row.normal;
  row.f = f;
  if (friction_ > 0) {
    const Vec3 rubbed = within(row.rubbed_speed - across(apart, row.normal) * row.per_D, friction_ * f);
    change += rubbed - row.rubbed_speed;
    row.rubbed_speed = rubbed;
  }
  return apply(row, change, kStill_m_s, v);
}

void GutResponse::begin_with(Row& row, const Vec3& warm, double step_s) const noexcept {
  row.f = warm.dot(row.normal);
  row.g = row.f * step_s;
  row.rubbed_speed = across(warm, row.normal);
  row.rubbed_way = row.rubbed_speed * step_s;
}

void GutResponse::prepare(std::span<const GutContact> contacts, std::span<const Vec3> before,
                          std::span<const double> inverse_mass) noexcept {
  rows_.clear();
  for (std::size_t c = 0; c < std::min(contacts.size(), rows_.capacity()); ++c)
    rows_.push_back(prepared(contacts[c], before, inverse_mass));
}

void GutResponse::solve(std::span<const GutContact> contacts, std::span<const Vec3> warm, double step_s,
                        const MovingMasses& masses) noexcept {
  prepare(contacts, masses.before, masses.inverse_mass);
  for (std::size_t c = 0; c < std::min(warm.size(), rows_.size()); ++c) begin_with(rows_[c], warm[c], step_s);
  bool is_moving = true;
  for (std::int32_t pass = 0; pass < passes_ && is_moving; ++pass) {
    is_moving = false;
    for (Row& row : rows_) {
      is_moving |= correct_places(row, masses.x);
      is_moving |= correct_speeds(row, masses.v);
    }
  }
}

void GutResponse::part(std::span<const Vec3> warm, double step_s, std::span<Vec3> x) noexcept {
  for (std::size_t c = 0; c < rows_.size(); ++c) begin_with(rows_[c], warm[c], step_s);
  for (std::int32_t pass = 0; pass < passes_; ++pass) {
    for (Row& row : rows_) correct_places(row, x);
  }
}

Vec3 GutResponse::impulse(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].f * rows_[contact].normal + rows_[contact].rubbed_speed;
}

Vec3 GutResponse::shift(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].g * rows_[contact].normal + rows_[contact].rubbed_way;
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
