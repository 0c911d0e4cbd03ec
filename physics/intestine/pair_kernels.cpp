#include "physics/intestine/pair_kernels.h"

namespace omentum::physics::kernels {

namespace {

constexpr std::size_t kLanes = 8;
constexpr double kParallel = 1e-10;  // as in gut_distance.cpp
// Squared sine of a triangle's angle below which its normal is rounding, and its edges are all there is.
constexpr double kNoArea = 1e-20;

typedef double Lanes __attribute__((vector_size(8 * kLanes)));
typedef std::int64_t Choice __attribute__((vector_size(8 * kLanes)));  // -1 where it holds, else 0

#define OMENTUM_PAIR_INLINE static inline __attribute__((always_inline))

struct Vec {
  Lanes x, y, z;
};

OMENTUM_PAIR_INLINE Vec minus(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
OMENTUM_PAIR_INLINE Vec plus(const Vec& a, Lanes s, const Vec& b) {
  return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
OMENTUM_PAIR_INLINE Lanes dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
OMENTUM_PAIR_INLINE Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
OMENTUM_PAIR_INLINE Lanes choose(Choice where, Lanes one, Lanes other) {
  return where ? one : other;
}
OMENTUM_PAIR_INLINE Lanes least(Lanes a, Lanes b) {
  return a < b ? a : b;
}
OMENTUM_PAIR_INLINE Lanes largest(Lanes a, Lanes b) {
  return a > b ? a : b;
}
OMENTUM_PAIR_INLINE Lanes unit(Lanes a) {
  return least(largest(a, Lanes{}), Lanes{} + 1);
}
OMENTUM_PAIR_INLINE Lanes absolute(Lanes a) {
  return largest(a, -a);
}
OMENTUM_PAIR_INLINE Lanes root(Lanes a) {
  Lanes r;
  for (std::size_t i = 0; i < kLanes; ++i) r[i] = __builtin_sqrt(a[i]);
  return r;
}
// 0 for what is 0, as for a segment without length.
OMENTUM_PAIR_INLINE Lanes inverse(Lanes a) {
  return choose(a > 0, 1 / a, Lanes{});
}
OMENTUM_PAIR_INLINE bool any(Choice where) {
  std::int64_t all = 0;
  for (std::size_t i = 0; i < kLanes; ++i) all |= where[i];
  return all != 0;
}

// Products of two segments r + s u and t v, and the nearest places of them (gut_distance.cpp has the same for
// one pair).
struct Products {
  Lanes uu, per_uu, vv, uv, ur, vr, rr;
};
struct Places {
  Lanes s, t, squared;
};

OMENTUM_PAIR_INLINE Places nearest(const Products& p) {
  const Lanes det = p.uu * p.vv - p.uv * p.uv, per_vv = inverse(p.vv);
  const Lanes beside = (unit(-p.ur * p.per_uu) + unit((p.uv - p.ur) * p.per_uu)) * 0.5;
  Lanes s = choose(det > kParallel * p.uu * p.vv, unit((p.uv * p.vr - p.ur * p.vv) / det), beside);
  const Lanes t = unit((p.uv * s + p.vr) * per_vv);
  s = choose(p.uu > 0, unit((p.uv * t - p.ur) * p.per_uu), s);
  return {s, t, p.rr + s * (s * p.uu + 2 * p.ur) + t * (t * p.vv - 2 * p.vr) - 2 * s * t * p.uv};
}

struct Found {
  Lanes s, weights[3], distance;
};

OMENTUM_PAIR_INLINE Found between_segments(const Vec& u, const Vec& r, const Vec& v) {
  const Lanes uu = dot(u, u);
  const Places at = nearest({uu, inverse(uu), dot(v, v), dot(u, v), dot(u, r), dot(v, r), dot(r, r)});
  const Vec between = plus(plus(r, at.s, u), -at.t, v);
  return {at.s, {1 - at.t, at.t, Lanes{}}, root(dot(between, between))};
}

// Of the nearest of the triangle's edges e, f - e and -f.
OMENTUM_PAIR_INLINE Found nearest_edge(const Vec& u, const Vec& r, const Vec& e, const Vec& f, Lanes ee,
                                       Lanes ef, Lanes ff, Lanes re, Lanes rf) {
  const Lanes uu = dot(u, u), per_uu = inverse(uu), ue = dot(u, e), uf = dot(u, f), ur = dot(u, r),
              rr = dot(r, r);
  const Places first = nearest({uu, per_uu, ee, ue, ur, re, rr});
  const Places second =
      nearest({uu, per_uu, ee - 2 * ef + ff, uf - ue, ur - ue, rf - re - ef + ee, rr - 2 * re + ee});
  const Places third = nearest({uu, per_uu, ff, -uf, ur - uf, ff - rf, rr - 2 * rf + ff});
  const Choice is_second = second.squared < first.squared;
  const Choice is_third = third.squared < choose(is_second, second.squared, first.squared);
  const Lanes s = choose(is_third, third.s, choose(is_second, second.s, first.s));
  const Lanes w0 = choose(is_third, third.t, choose(is_second, Lanes{}, 1 - first.t));
  const Lanes w1 = choose(is_third, Lanes{}, choose(is_second, 1 - second.t, first.t));
  const Lanes w2 = choose(is_third, 1 - third.t, choose(is_second, second.t, Lanes{}));
  const Vec between = plus(plus(plus(r, s, u), -w1, e), -w2, f);
  return {s, {w0, w1, w2}, root(dot(between, between))};
}

OMENTUM_PAIR_INLINE Found to_triangle(const Vec& u, const Vec& r, const Vec& e, const Vec& f,
                                      Lanes farthest) {
  const Vec normal = cross(e, f);
  const Lanes ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), squared = dot(normal, normal);
  const Lanes at_p = dot(r, normal), at_q = at_p + dot(u, normal);
  const Choice has_area = squared > kNoArea * ee * ff, crosses = (at_p * at_q <= 0) & (at_p != at_q);
  const Lanes lower = least(absolute(at_p), absolute(at_q)), height = lower / root(squared);
  const Choice is_far = has_area & ~crosses & (lower * lower > farthest * farthest * squared);
  const Lanes s =
      choose(crosses, at_p / (at_p - at_q), choose(absolute(at_p) <= absolute(at_q), Lanes{}, Lanes{} + 1));
  const Vec place = plus(r, s, u);
  const Lanes pe = dot(place, e), pf = dot(place, f), w1 = (ff * pe - ef * pf) / squared,
              w2 = (ee * pf - ef * pe) / squared, w0 = 1 - w1 - w2;
  const Choice is_over = has_area & (w0 >= 0) & (w1 >= 0) & (w2 >= 0);
  Found found{s, {w0, w1, w2}, choose(crosses, Lanes{}, height)};
  const Choice at_edge = ~(is_far | is_over);
  if (any(at_edge)) {
    const Found edge = nearest_edge(u, r, e, f, ee, ef, ff, dot(r, e), dot(r, f));
    found.s = choose(at_edge, edge.s, s);
    for (int k = 0; k < 3; ++k) found.weights[k] = choose(at_edge, edge.weights[k], found.weights[k]);
    found.distance = choose(at_edge, edge.distance, found.distance);
  }
  found.s = choose(is_far, Lanes{}, found.s);
  for (int k = 0; k < 3; ++k) found.weights[k] = choose(is_far, Lanes{} + (k == 0), found.weights[k]);
  return found;
}

// Lanes behind the last pair repeat it.
template <int corners, class Measure>
OMENTUM_PAIR_INLINE void measure_all(std::size_t count, const PartCorners* pairs, const double* x,
                                     MeasuredPair* found, const Measure& measure) {
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t n = count - first < kLanes ? count - first : kLanes;
    alignas(64) double at[2 + corners][3][kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) {
      const PartCorners& pair = pairs[first + (i < n ? i : n - 1)];
      for (int c = 0; c < 2 + corners; ++c) {
        const double* const from =
            x + 3 * static_cast<std::ptrdiff_t>(c < 2 ? pair.of_segment[c] : pair.of_part[c - 2]);
        for (int k = 0; k < 3; ++k) at[c][k][i] = from[k];
      }
    }
    Vec corner[2 + corners];
    for (int c = 0; c < 2 + corners; ++c)
      corner[c] = {*reinterpret_cast<const Lanes*>(at[c][0]), *reinterpret_cast<const Lanes*>(at[c][1]),
                   *reinterpret_cast<const Lanes*>(at[c][2])};
    const Found result = measure(corner, first, n);
    for (std::size_t i = 0; i < n; ++i)
      found[first + i] = {result.s[i],
                          {result.weights[0][i], result.weights[1][i], result.weights[2][i]},
                          result.distance[i]};
  }
}

}  // namespace

void measure_segments(std::size_t count, const PartCorners* pairs, const double* x,
                      MeasuredPair* found) noexcept {
  measure_all<2>(count, pairs, x, found, [](const Vec* at, std::size_t, std::size_t) {
    return between_segments(minus(at[1], at[0]), minus(at[0], at[2]), minus(at[3], at[2]));
  });
}

void measure_triangles(std::size_t count, const PartCorners* pairs, const double* x, const double* farthest_m,
                       MeasuredPair* found) noexcept {
  measure_all<3>(count, pairs, x, found, [&](const Vec* at, std::size_t first, std::size_t n) {
    Lanes farthest{};
    for (std::size_t i = 0; i < n; ++i) farthest[i] = farthest_m[first + i];
    return to_triangle(minus(at[1], at[0]), minus(at[0], at[2]), minus(at[3], at[2]), minus(at[4], at[2]),
                       farthest);
  });
}

std::size_t find_awake(std::size_t count, const double* slack_m, const std::int32_t* one,
                       const std::int32_t* other, const double* ahead_m, std::int32_t* awake) noexcept {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    awake[found] = static_cast<std::int32_t>(i);
    found += slack_m[i] <= ahead_m[one[i]] + ahead_m[other[i]] ? 1 : 0;
  }
  return found;
}

std::uint32_t find_near_balls(std::size_t count, const Balls& balls, const BallLine& line, double around_m,
                              double* separation_m) noexcept {
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = balls.x[i] - line.start[0], y = balls.y[i] - line.start[1],
                 z = balls.z[i] - line.start[2];
    double t = (x * line.along[0] + y * line.along[1] + z * line.along[2]) * line.per_length;
    t = t > 0 ? t : 0;
    t = t < 1 ? t : 1;
    const double dx = x - t * line.along[0], dy = y - t * line.along[1], dz = z - t * line.along[2];
    separation_m[i] = __builtin_sqrt(dx * dx + dy * dy + dz * dz) - balls.radius[i];
  }
  for (std::size_t i = 0; i < count; ++i) near |= (separation_m[i] <= around_m ? 1U : 0U) << i;
  return near;
}

}  // namespace omentum::physics::kernels
