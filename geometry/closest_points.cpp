#include "geometry/closest_points.h"

#include <algorithm>
#include <cmath>

namespace omentum::geometry {
namespace {

// How far outside [0,1] a segment's parameter may be and still count: a few roundings, so that of two
// consecutive segments that meet on the surface at least one hits it.
constexpr double kEndTolerance = 1e-12;

// Along a -> b, clamped to the edge; an edge without length is its start.
double edge_parameter(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length_squared = along.squaredNorm();
  return length_squared > 0 ? std::clamp((p - a).dot(along) / length_squared, 0.0, 1.0) : 0.0;
}

TrianglePoint closest_point_on_border(const Vec3& p, const std::array<Vec3, 3>& corners) {
  TrianglePoint best{Vec3::UnitX(), (p - corners[0]).squaredNorm()};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double t = edge_parameter(p, corners[i], corners[j]);
    const double squared = (p - (corners[i] + t * (corners[j] - corners[i]))).squaredNorm();
    if (squared >= best.squared_distance) continue;
    best.squared_distance = squared;
    best.barycentric.setZero();
    best.barycentric[i] = 1 - t;
    best.barycentric[j] = t;
  }
  return best;
}

// A point seen along the segment: two coordinates across it, one along.
struct Seen {
  double x, y, along;
};

// Looks along p -> q: shears space so that the segment becomes its own dominant axis (Woop, Benthin and Wald
// 2013, "Watertight ray/triangle intersection").
class View {
 public:
  View(const Vec3& p, const Vec3& q) : origin_(p), direction_(q - p) {
    direction_.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
  }
  bool empty() const { return direction_[z_] == 0; }
  Seen see(const Vec3& point) const {
    const Vec3 v = point - origin_;
    const double along = v[z_] / direction_[z_];
    return {v[x_] - along * direction_[x_], v[y_] - along * direction_[y_], along};
  }

 private:
  Vec3 origin_, direction_;
  Eigen::Index x_, y_, z_;
};

// Twice the signed area of (origin, a, b), with a sign that is right or zero, never wrong: rounding is
// monotone, so comparing the two rounded products cannot invert them. Hence a shared edge is seen alike from
// both sides.
double area(const Seen& a, const Seen& b) {
  const double left = a.x * b.y;
  const double right = a.y * b.x;
  if (left == right) return 0;
  const double difference = std::abs(left - right);
  return left > right ? difference : -difference;
}

}  // namespace

TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double normal_squared = normal.squaredNorm();
  if (normal_squared > 0) {
    const double wa = (c - b).cross(p - b).dot(normal) / normal_squared;
    const double wb = (a - c).cross(p - c).dot(normal) / normal_squared;
    const double wc = 1 - wa - wb;
    if (wa >= 0 && wb >= 0 && wc >= 0) {
      const double height = (p - a).dot(normal);
      return {{wa, wb, wc}, height * height / normal_squared};
    }
  }
  return closest_point_on_border(p, {a, b, c});
}

std::optional<SegmentHit> intersect_segment_triangle(const Vec3& p, const Vec3& q, const Vec3& a,
                                                     const Vec3& b, const Vec3& c) {
  const View view(p, q);
  if (view.empty()) return std::nullopt;
  const Seen sa = view.see(a), sb = view.see(b), sc = view.see(c);
  const double wa = area(sb, sc), wb = area(sc, sa), wc = area(sa, sb);
  if (std::min({wa, wb, wc}) < 0 && std::max({wa, wb, wc}) > 0) return std::nullopt;
  const double total = wa + wb + wc;
  if (total == 0) return std::nullopt;
  const Vec3 barycentric = Vec3(wa, wb, wc) / total;
  const double parameter = barycentric.dot(Vec3(sa.along, sb.along, sc.along));
  if (parameter < -kEndTolerance || parameter > 1 + kEndTolerance) return std::nullopt;
  return SegmentHit{std::clamp(parameter, 0.0, 1.0), barycentric};
}

}  // namespace omentum::geometry
