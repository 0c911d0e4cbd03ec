#include "physics/intestine/gut_response.h"

#include "geometry/across.h"

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

Eigen::Map<Vec3> vector(double* components) {
  return Eigen::Map<Vec3>(components);
}
Eigen::Map<const Vec3> vector(const double* components) {
  return Eigen::Map<const Vec3>(components);
}

}  // namespace

GutResponse::GutResponse(std::size_t most_contacts, std::int32_t passes, double friction)
    : passes_(passes), friction_(friction) {
  rows_.reserve(most_contacts);
}

GutResponse::Row GutResponse::prepared(const GutContact& contact, std::span<const Vec3> before,
                                       std::span<const double> inverse_mass) const noexcept {
  Row row{};
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
  vector(row.normal) = contact.normal;
  row.per_D = D > kNoYield ? 1 / D : 0;
  const bool at_wall = !contact.other.mass[0].valid();
  row.offset = contact.reach_m + (at_wall ? contact.place.dot(contact.normal) : 0);
  vector(row.wall_velocity) = contact.velocity;
  vector(row.before) = weighted(row, before);
  return row;
}

void GutResponse::begin_with(Row& row, const Vec3& warm, double step_s) const noexcept {
  row.f = warm.dot(vector(row.normal));
  row.g = row.f * step_s;
  vector(row.rubbed_speed) = geometry::across(warm, vector(row.normal));
  vector(row.rubbed_way) = vector(row.rubbed_speed) * step_s;
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
  pass(masses.x, masses.v.data()->data());
}

void GutResponse::pass(std::span<Vec3> x, double* v) noexcept {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  bool goes_on = !rows_.empty();
  for (std::int32_t pass = 0; goes_on && pass < passes_; ++pass)
    goes_on = kernels::correct_contacts(rows_.size(), rows_.data(), friction_, x.data()->data(), v);
}

void GutResponse::part(std::span<const Vec3> warm, double step_s, std::span<Vec3> x) noexcept {
  for (std::size_t c = 0; c < rows_.size(); ++c) begin_with(rows_[c], warm[c], step_s);
  pass(x, nullptr);
}

Vec3 GutResponse::impulse(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].f * vector(rows_[contact].normal) + vector(rows_[contact].rubbed_speed);
}

Vec3 GutResponse::shift(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].g * vector(rows_[contact].normal) + vector(rows_[contact].rubbed_way);
}

std::int32_t GutResponse::pushing() const noexcept {
  return static_cast<std::int32_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.g > 0 || row.f > 0; }));
}

double GutResponse::deepest_m(const MovingMasses& masses) const noexcept {
  double deepest = 0;
  for (const Row& row : rows_) {
    if (row.per_D > 0)
      deepest = std::max(deepest, row.offset - weighted(row, masses.x).dot(vector(row.normal)));
  }
  return deepest;
}

}  // namespace omentum::physics
