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

// Takes `gone`, a way or speed of the first point from the second, back along the normal as far as that
// pushes. Whether that was more than `unmoved`.
template <std::int32_t count>
OMENTUM_CONTACT_INLINE bool push(const ContactRow& row, const Lanes4& normal, double gone, double unmoved,
                                 double& pushed, double* to) {
  const double was = pushed;
  pushed = not_below_0(was - gone * row.per_D);
  if (pushed == was) return false;
  add<count>(row, (pushed - was) * normal, to);
  return gone * gone > unmoved * unmoved;
}

// The same across the normal, as far as `most` allows.
template <std::int32_t count>
OMENTUM_CONTACT_INLINE bool rub(const ContactRow& row, const Lanes4& normal, const Lanes4& gone,
                                double unmoved, double most, double* rubbed, double* to) {
  const Lanes4 was = load(rubbed);
  Lanes4 sum = was - (gone - dot(gone, normal) * normal) * row.per_D;
  const double squared = dot(sum, sum);
  if (squared > most * most) sum *= most / __builtin_sqrt(squared);
  const Lanes4 change = sum - was;
  add<count>(row, change, to);
  store(sum, rubbed);
  return dot(change, change) > unmoved * unmoved * row.per_D * row.per_D;
}

OMENTUM_CONTACT_INLINE bool rubs(double pushed, const double* rubbed) {
  return pushed > 0 || rubbed[0] != 0 || rubbed[1] != 0 || rubbed[2] != 0;
}

template <std::int32_t count>
bool correct(ContactRow& row, double friction, double* x, double* v) {
  const Lanes4 normal = load(row.normal);
  const double open = dot(weighted<count>(row, x), normal) - row.offset;
  bool moved = push<count>(row, normal, open, kUnmoved_m, row.g, x);
  if (v != nullptr && (row.g > 0 || row.f > 0)) {
    const double speed = dot(weighted<count>(row, v) - load(row.wall_velocity), normal);
    moved |= push<count>(row, normal, speed, kUnmoved_m_s, row.f, v);
  }
  if (!(friction > 0)) return moved;
  if (rubs(row.g, row.rubbed_way)) {
    const Lanes4 way = weighted<count>(row, x) - load(row.before);
    moved |= rub<count>(row, normal, way, kUnmoved_m, friction * row.g, row.rubbed_way, x);
  }
  if (v != nullptr && rubs(row.f, row.rubbed_speed)) {
    const Lanes4 speed = weighted<count>(row, v) - load(row.wall_velocity);
    moved |= rub<count>(row, normal, speed, kUnmoved_m_s, friction * row.f, row.rubbed_speed, v);
  }
  return moved;
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
