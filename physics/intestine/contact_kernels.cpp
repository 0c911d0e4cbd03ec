#include "physics/intestine/contact_kernels.h"

namespace omentum::physics::kernels {

namespace {

typedef double Lanes4 __attribute__((vector_size(32)));

#define OMENTUM_CONTACT_INLINE static inline __attribute__((always_inline))

OMENTUM_CONTACT_INLINE Lanes4 load(const double* vector) {
  return Lanes4{vector[0], vector[1], vector[2], 0};
}
OMENTUM_CONTACT_INLINE void store(const Lanes4& lanes, double* vector) {
  for (int k = 0; k < 3; ++k) vector[k] = lanes[k];
}
OMENTUM_CONTACT_INLINE double dot(const Lanes4& a, const Lanes4& b) {
  const Lanes4 product = a * b;
  return product[0] + product[1] + product[2];
}
OMENTUM_CONTACT_INLINE double not_below_0(double a) {
  return a > 0 ? a : 0;
}

template <std::int32_t count>
OMENTUM_CONTACT_INLINE Lanes4 weighted(const ContactRow& row, const double* of) {
  Lanes4 sum{};
  for (std::int32_t k = 0; k < count; ++k)
    sum += row.weight[k] * load(of + 3 * static_cast<std::ptrdiff_t>(row.mass[k]));
  return sum;
}

template <std::int32_t count>
OMENTUM_CONTACT_INLINE void add(const ContactRow& row, const Lanes4& impulse, double* to) {
  for (std::int32_t k = 0; k < count; ++k) {
    double* const at = to + 3 * static_cast<std::ptrdiff_t>(row.mass[k]);
    store(load(at) + row.yield[k] * impulse, at);
  }
}

OMENTUM_CONTACT_INLINE bool is_zero(const double* vector) {
  return vector[0] == 0 && vector[1] == 0 && vector[2] == 0;
}

// What a contact has given along its normal and across it, of places or of velocities.
struct Given {
  double &push, *rub;
};

// `apart`: of its first point from the second; `slid`: the same from where nothing would have been rubbed.
// What pushes does not move across the normal, and the other way round: both from one look. Whether that
// moved it by more than `unmoved`.
template <std::int32_t count>
OMENTUM_CONTACT_INLINE bool correct(const ContactRow& row, const Lanes4& apart, double offset,
                                    const Lanes4& slid, double friction, double unmoved, const Given& given,
                                    double* to) {
  const Lanes4 normal = load(row.normal);
  const double push = not_below_0(given.push - (dot(apart, normal) - offset) * row.per_D);
  Lanes4 change = (push - given.push) * normal;
  given.push = push;
  if (friction > 0 && (push > 0 || !is_zero(given.rub))) {
    const Lanes4 was = load(given.rub);
    Lanes4 rub = was - (slid - dot(slid, normal) * normal) * row.per_D;
    const double most = friction * push, squared = dot(rub, rub);
    if (squared > most * most) rub *= most / __builtin_sqrt(squared);
    change += rub - was;
    store(rub, given.rub);
  }
  const double squared = dot(change, change);
  if (squared == 0) return false;
  add<count>(row, change, to);
  return squared > unmoved * unmoved * row.per_D * row.per_D;
}

template <std::int32_t count>
bool correct(ContactRow& row, double friction, double* x, double* v) {
  const Lanes4 apart = weighted<count>(row, x);
  const bool moved = correct<count>(row, apart, row.offset, apart - load(row.before), friction, kUnmoved_m,
                                    {row.g, row.rubbed_way}, x);
  if (v == nullptr || (row.g <= 0 && row.f <= 0 && is_zero(row.rubbed_speed))) return moved;
  const Lanes4 speed = weighted<count>(row, v) - load(row.wall_velocity);
  return correct<count>(row, speed, 0, speed, friction, kUnmoved_m_s, {row.f, row.rubbed_speed}, v) || moved;
}

// Calls with the number of a row's masses, so that loops over them unroll.
template <class Visit>
OMENTUM_CONTACT_INLINE auto with_count(const ContactRow& row, const Visit& visit) {
  switch (row.count) {
    case 1:
      return visit.template operator()<1>();
    case 2:
      return visit.template operator()<2>();
    case 3:
      return visit.template operator()<3>();
    case 4:
      return visit.template operator()<4>();
    case 5:
      return visit.template operator()<5>();
    default:
      return visit.template operator()<6>();
  }
}

}  // namespace

bool correct_contacts(std::size_t count, ContactRow* rows, double friction, double* x, double* v) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < count; ++i)
    moved |= with_count(rows[i], [&]<std::int32_t n>() { return correct<n>(rows[i], friction, x, v); });
  return moved;
}

void begin_contacts(std::size_t count, ContactRow* rows, const double* warm, double step_s) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    ContactRow& row = rows[i];
    const Lanes4 given = load(warm + 3 * i), normal = load(row.normal);
    row.f = dot(given, normal);
    row.g = row.f * step_s;
    const Lanes4 rubbed = given - row.f * normal;
    store(rubbed, row.rubbed_speed);
    store(rubbed * step_s, row.rubbed_way);
  }
}

PushChange find_ways(std::size_t count, const ContactRow* rows, const double* pushes, double step_s,
                     double* ways) noexcept {
  PushChange sums{};
  for (std::size_t i = 0; i < count; ++i) {
    const Lanes4 push = load(pushes + 3 * i);
    const Lanes4 way = (rows[i].g * load(rows[i].normal) + load(rows[i].rubbed_way)) / step_s - push;
    store(way, ways + 3 * i);
    sums.change_n_s += __builtin_sqrt(dot(way, way));
    sums.total_n_s += __builtin_sqrt(dot(push, push));
  }
  return sums;
}

void add_pushes(std::size_t count, const ContactRow* rows, const double* pushes, double step_s,
                double* forces) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    if (is_zero(pushes + 3 * i)) continue;
    const Lanes4 force = load(pushes + 3 * i) / step_s;
    for (std::int32_t k = 0; k < rows[i].count; ++k) {
      double* const at = forces + 3 * static_cast<std::ptrdiff_t>(rows[i].mass[k]);
      store(load(at) + rows[i].weight[k] * force, at);
    }
  }
}

AlongWays look_along(std::size_t count, const ContactRow* rows, const double* ways, const double* x,
                     const double* yields) noexcept {
  AlongWays sums{};
  for (std::size_t i = 0; i < count; ++i) {
    const ContactRow& row = rows[i];
    if (is_zero(ways + 3 * i)) continue;
    const auto between = [&](const double* of) {
      return with_count(row, [&]<std::int32_t n>() { return weighted<n>(row, of); });
    };
    const Lanes4 way = load(ways + 3 * i), normal = load(row.normal), now = between(x);
    const double along = dot(way, normal);
    sums.gain -= along * (dot(now, normal) - row.offset) + dot(way - along * normal, now - load(row.before));
    sums.cost += dot(way, between(yields));
  }
  return sums;
}

}  // namespace omentum::physics::kernels
