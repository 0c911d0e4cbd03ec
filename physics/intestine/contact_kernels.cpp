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

bool correct(ContactRow& row, double friction, double* x, double* v) {
  switch (row.count) {
    case 1:
      return correct<1>(row, friction, x, v);
    case 2:
      return correct<2>(row, friction, x, v);
    case 3:
      return correct<3>(row, friction, x, v);
    case 4:
      return correct<4>(row, friction, x, v);
    case 5:
      return correct<5>(row, friction, x, v);
    default:
      return correct<6>(row, friction, x, v);
  }
}

}  // namespace

bool correct_contacts(std::size_t count, ContactRow* rows, double friction, double* x, double* v) noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < count; ++i) moved |= correct(rows[i], friction, x, v);
  return moved;
}

}  // namespace omentum::physics::kernels
