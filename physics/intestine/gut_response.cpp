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

void GutResponse::begin_with(std::span<const Vec3> warm, double step_s) noexcept {
  const std::size_t count = std::min(warm.size(), rows_.size());
  if (count > 0) kernels::begin_contacts(count, rows_.data(), warm.data()->data(), step_s);
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
  begin_with(warm, step_s);
  pass(masses.x, masses.v.data()->data());
}

void GutResponse::pass(std::span<Vec3> x, double* v) noexcept {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  bool goes_on = !rows_.empty();
  for (std::int32_t pass = 0; goes_on && pass < passes_; ++pass)
    goes_on = kernels::correct_contacts(rows_.size(), rows_.data(), friction_, x.data()->data(), v);
}

void GutResponse::part(std::span<const Vec3> warm, double step_s, std::span<Vec3> x) noexcept {
  begin_with(warm, step_s);
  pass(x, nullptr);
}

Vec3 GutResponse::impulse(std::size_t contact) const noexcept {
  if (contact >= rows_.size()) return Vec3::Zero();
  return rows_[contact].f * vector(rows_[contact].normal) + vector(rows_[contact].rubbed_speed);
}

kernels::PushChange GutResponse::find_ways(std::span<const Vec3> pushes, double step_s,
                                           std::span<Vec3> ways) const noexcept {
  if (rows_.empty()) return {};
  return kernels::find_ways(rows_.size(), rows_.data(), pushes.data()->data(), step_s, ways.data()->data());
}

void GutResponse::add_pushes(std::span<const Vec3> pushes, double step_s,
                             std::span<Vec3> forces) const noexcept {
  if (rows_.empty()) return;
  kernels::add_pushes(rows_.size(), rows_.data(), pushes.data()->data(), step_s, forces.data()->data());
}

kernels::AlongWays GutResponse::look_along(std::span<const Vec3> ways, std::span<const Vec3> x,
                                           std::span<const Vec3> yields) const noexcept {
  if (rows_.empty()) return {};
  return kernels::look_along(rows_.size(), rows_.data(), ways.data()->data(), x.data()->data(),
                             yields.data()->data());
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
