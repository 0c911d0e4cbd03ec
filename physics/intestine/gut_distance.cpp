#include "physics/intestine/gut_distance.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Squared sine of the angle below which two segments are parallel: beyond, rounding decides where they meet.
constexpr double kParallel = 1e-10;

double unit(double x) {
  return std::clamp(x, 0.0, 1.0);
}

// Products of two segments r + s u and t v.
struct Products {
  double uu, vv, uv, ur, vr, rr;
};

struct Places {
  double s, t, squared;
};

// Where the first segment is nearest to the other's line, or the middle of what it has beside the other.
double first_guess(const Products& p) {
  const double det = p.uu * p.vv - p.uv * p.uv;
  if (det > kParallel * p.uu * p.vv) return unit((p.uv * p.vr - p.ur * p.vv) / det);
  if (p.uu <= 0) return 0;
  return (unit(-p.ur / p.uu) + unit((p.uv - p.ur) / p.uu)) / 2;
}

Places nearest(const Products& p) {
  Places at{first_guess(p), 0, 0};
  if (p.vv > 0) at.t = unit((p.uv * at.s + p.vr) / p.vv);
  if (p.uu > 0) at.s = unit((p.uv * at.t - p.ur) / p.uu);
  at.squared =
      p.rr + at.s * (at.s * p.uu + 2 * p.ur) + at.t * (at.t * p.vv - 2 * p.vr) - 2 * at.s * at.t * p.uv;
  return at;
}

// A triangle's plane: edges e and f from the first corner, and the products that barycentric coordinates
// need.
struct Frame {
  Vec3 e, f, normal;
  double ee, ef, ff, squared;
  Frame(const Vec3& a, const Vec3& b, const Vec3& c)
      : e(b - a),
        f(c - a),
        normal(e.cross(f)),
        ee(e.squaredNorm()),
        ef(e.dot(f)),
        ff(f.squaredNorm()),
        squared(normal.squaredNorm()) {}
  // of a point whose products with e and f these are
  Vec3 weights(double re, double rf) const {
    const double b = (ff * re - ef * rf) / squared, c = (ee * rf - ef * re) / squared;
    return {1 - b - c, b, c};
  }
};

Vec3 on_edge(int edge, double t) {
  Vec3 weights = Vec3::Zero();
  weights[edge] = 1 - t;
  weights[(edge + 1) % 3] = t;
  return weights;
}

// The nearest of the three edges.
PairPlaces nearest_edge(const Frame& frame, const Vec3& u, const Vec3& r) {
  const double uu = u.squaredNorm(), ue = u.dot(frame.e), uf = u.dot(frame.f);
  const double re = r.dot(frame.e), rf = r.dot(frame.f), ur = u.dot(r), rr = r.squaredNorm();
  const double from_b = rr - 2 * re + frame.ee, from_c = rr - 2 * rf + frame.ff;
  const std::array<Places, 3> at{nearest({uu, frame.ee, ue, ur, re, rr}),
                                 nearest({uu, frame.ee - 2 * frame.ef + frame.ff, uf - ue, ur - ue,
                                          rf - re - frame.ef + frame.ee, from_b}),
                                 nearest({uu, frame.ff, -uf, ur - uf, frame.ff - rf, from_c})};
  int best = at[1].squared < at[0].squared ? 1 : 0;
  if (at[2].squared < at[static_cast<std::size_t>(best)].squared) best = 2;
  const Places& places = at[static_cast<std::size_t>(best)];
  return {places.s, on_edge(best, places.t), 0};
}

}  // namespace

PairPlaces between_segments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 u = q - p, v = b - a, r = p - a;
  const Places at =
      nearest({u.squaredNorm(), v.squaredNorm(), u.dot(v), u.dot(r), v.dot(r), r.squaredNorm()});
  return {at.s, Vec3(1 - at.t, at.t, 0), (r + at.s * u - at.t * v).norm()};
}

PairPlaces between_segment_and_triangle(const Vec3& p, const Vec3& q,
                                        const std::array<const Vec3*, 3>& corners,
                                        double farthest_m) noexcept {
  const Vec3& a = *corners[0];
  const Frame frame(a, *corners[1], *corners[2]);
  const Vec3 u = q - p, r = p - a;
  const double at_p = r.dot(frame.normal), at_q = at_p + u.dot(frame.normal);
  const bool crosses = at_p * at_q <= 0 && at_p != at_q;
  if (frame.squared > 0) {
    const double height = std::min(std::abs(at_p), std::abs(at_q));
    if (!crosses && height * height > farthest_m * farthest_m * frame.squared)
      return {0, Vec3::UnitX(), height / std::sqrt(frame.squared)};
    // nearest to the plane is where it crosses, or the lower end; if that is over the triangle, nothing is
    // nearer
    const double s = crosses ? at_p / (at_p - at_q) : (std::abs(at_p) <= std::abs(at_q) ? 0 : 1);
    const Vec3 weights = frame.weights((r + s * u).dot(frame.e), (r + s * u).dot(frame.f));
    if (weights.minCoeff() >= 0) return {s, weights, crosses ? 0 : height / std::sqrt(frame.squared)};
  }
  PairPlaces best = nearest_edge(frame, u, r);
  best.distance_m = (r + best.s * u - best.other[1] * frame.e - best.other[2] * frame.f).norm();
  return best;
}

}  // namespace omentum::physics
