#include "geometry/segment_points.h"

#include "geometry/closest_points.h"

#include <algorithm>

namespace omentum::geometry {
namespace {

// Squared sine of the angle below which two segments are parallel: beyond, rounding alone decides where they
// would meet.
constexpr double kParallelSquared = 1e-28;

// Square of the share of their size within which two points of segment and triangle are one: what is left of
// double precision when they cross at a ten-millionth of a right angle.
constexpr double kSamePlace = 1e-18;

// Along p + s * along, nearest to `to`; 0 on a segment without length.
double nearest_parameter(const Vec3& p, const Vec3& along, const Vec3& to) noexcept {
  const double length_squared = along.squaredNorm();
  return length_squared > 0 ? std::clamp((to - p).dot(along) / length_squared, 0.0, 1.0) : 0.0;
}

// Where the two lines are nearest, along the first. From cross products: the difference of products in the
// usual formula has no digit left long before the lines are parallel.
double line_parameter(const Vec3& between, const Vec3& d1, const Vec3& d2) noexcept {
  const Vec3 normal = d1.cross(d2);
  const double squared = normal.squaredNorm();
  if (squared <= kParallelSquared * d1.squaredNorm() * d2.squaredNorm()) return 0;
  return std::clamp(between.cross(d2).dot(normal) / squared, 0.0, 1.0);
}

// A hit whose two points are one. In the triangle's own plane rounding decides what is a hit, and where; ends
// and edges know better there.
std::optional<SegmentTrianglePair> crossing_of(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                                               const Vec3& c) noexcept {
  const auto hit = intersect_segment_triangle(p, q, a, b, c);
  if (!hit) return std::nullopt;
  const Vec3 on_segment = p + hit->parameter * (q - p);
  const Vec3 on_triangle = hit->barycentric[0] * a + hit->barycentric[1] * b + hit->barycentric[2] * c;
  const double size = (q - p).squaredNorm() + (b - a).squaredNorm() + (c - a).squaredNorm();
  if ((on_segment - on_triangle).squaredNorm() > kSamePlace * size) return std::nullopt;
  return SegmentTrianglePair{hit->parameter, hit->barycentric, 0};
}

}  // namespace

SegmentPair closest_points_of_segments(const Vec3& p1, const Vec3& q1, const Vec3& p2,
                                       const Vec3& q2) noexcept {
  const Vec3 d1 = q1 - p1, d2 = q2 - p2;
  double s = line_parameter(p2 - p1, d1, d2);
  const double t = nearest_parameter(p2, d2, p1 + s * d1);
  // held back at an end of the second, the first one's nearest place is another
  s = nearest_parameter(p1, d1, p2 + t * d2);
  return {s, t, (p1 + s * d1 - p2 - t * d2).squaredNorm()};
}

SegmentTrianglePair closest_points_of_segment_and_triangle(const Vec3& p, const Vec3& q, const Vec3& a,
                                                           const Vec3& b, const Vec3& c) noexcept {
  if (const auto crossing = crossing_of(p, q, a, b, c)) return *crossing;
  const TrianglePoint at_p = closest_point_on_triangle(p, a, b, c);
  SegmentTrianglePair best{0, at_p.barycentric, at_p.squared_distance};
  const TrianglePoint at_q = closest_point_on_triangle(q, a, b, c);
  if (at_q.squared_distance < best.squared_distance) best = {1, at_q.barycentric, at_q.squared_distance};
  const std::array corners{&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const SegmentPair pair = closest_points_of_segments(p, q, *corners[static_cast<std::size_t>(i)],
                                                        *corners[static_cast<std::size_t>(j)]);
    if (pair.squared_distance >= best.squared_distance) continue;
    best = {pair.s, Vec3::Zero(), pair.squared_distance};
    best.barycentric[i] = 1 - pair.t;
    best.barycentric[j] = pair.t;
  }
  return best;
}

}  // namespace omentum::geometry
