#include "physics/intestine/gut_crossings.h"

#include "geometry/closest_points.h"
#include "geometry/segment_points.h"

#include <cmath>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Two that meet at a root of the cubic are this near each other, m: a hundred times the rounding of the root.
constexpr double kMeeting_m = 1e-9;
constexpr double kWayRounding = 1e-9;  // of a way

// ((c - a) x (d - a)) . (b - a) along the ways, as c0 + c1 t + c2 t^2 + c3 t^3.
std::array<double, 4> volume(const Way& a, const Way& b, const Way& c, const Way& d) {
  const Vec3 u0 = b.from - a.from, v0 = c.from - a.from, w0 = d.from - a.from;
  const Vec3 u1 = b.to - a.to - u0, v1 = c.to - a.to - v0, w1 = d.to - a.to - w0;
  return {v0.cross(w0).dot(u0), v1.cross(w0).dot(u0) + v0.cross(w1).dot(u0) + v0.cross(w0).dot(u1),
          v1.cross(w1).dot(u0) + v1.cross(w0).dot(u1) + v0.cross(w1).dot(u1), v1.cross(w1).dot(u1)};
}

double value(const std::array<double, 4>& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

// Where the cubic may turn between 0 and 1, with both ends.
std::vector<double> turns(const std::array<double, 4>& c) {
  std::vector<double> at{0, 1};
  const double a = 3 * c[3], b = 2 * c[2], disc = b * b - 4 * a * c[1];
  if (disc >= 0) {
    const double q = -(b + std::copysign(std::sqrt(disc), b)) / 2;
    for (const double t : {q / a, c[1] / q})
      if (t > 0 && t < 1) at.push_back(t);
  }
  std::ranges::sort(at);
  return at;
}

// The root between two places of different sign.
double root(const std::array<double, 4>& c, double low, double high) {
  const bool rises = value(c, high) > value(c, low);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((value(c, middle) > 0) == rises ? high : low) = middle;
  }
  return high;
}

template <class Meets>
bool meets_in_plane(const std::array<double, 4>& c, const Meets& meets) {
  const std::vector<double> at = turns(c);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (meets(at[i]) || meets(at[i + 1])) return true;  // a double root is where it turns
    if (value(c, at[i]) * value(c, at[i + 1]) <= 0 && meets(root(c, at[i], at[i + 1]))) return true;
  }
  return false;
}

Eigen::AlignedBox3d swept(std::span<const geometry::MassId> masses, std::span<const Vec3> from,
                          std::span<const Vec3> to) {
  Eigen::AlignedBox3d box;
  for (const geometry::MassId m : masses)
    if (m.valid()) box.extend(from[m]).extend(to[m]);
  return box;
}

// How far the farthest of a part's masses goes.
double longest_way(std::span<const geometry::MassId> masses, std::span<const Vec3> from,
                   std::span<const Vec3> to) {
  double longest = 0;
  for (const geometry::MassId m : masses)
    if (m.valid()) longest = std::max(longest, (to[m] - from[m]).norm());
  return longest;
}

double squared_distance(const std::array<geometry::MassId, 3>& s, const std::array<geometry::MassId, 3>& m,
                        std::span<const Vec3> x) {
  if (!m[2].valid())
    return geometry::closest_points_of_segments(x[s[0]], x[s[1]], x[m[0]], x[m[1]]).squared_distance;
  return geometry::closest_points_of_segment_and_triangle(x[s[0]], x[s[1]], x[m[0]], x[m[1]], x[m[2]])
      .squared_distance;
}

bool parts_meet(const std::array<geometry::MassId, 3>& s, const std::array<geometry::MassId, 3>& m,
                std::span<const Vec3> from, std::span<const Vec3> to) {
  const auto way = [&](geometry::MassId mass) { return Way{from[mass], to[mass]}; };
  const Way p = way(s[0]), q = way(s[1]), a = way(m[0]), b = way(m[1]);
  if (edges_meet(p, q, a, b)) return true;
  if (!m[2].valid()) return false;
  const Way c = way(m[2]);
  return edges_meet(p, q, b, c) || edges_meet(p, q, c, a) || point_meets_triangle(p, a, b, c) ||
         point_meets_triangle(q, a, b, c);
}

}  // namespace

bool edges_meet(const Way& p, const Way& q, const Way& a, const Way& b) {
  return meets_in_plane(volume(p, q, a, b), [&](double t) {
    return geometry::closest_points_of_segments(p.at(t), q.at(t), a.at(t), b.at(t)).squared_distance <
           kMeeting_m * kMeeting_m;
  });
}

bool point_meets_triangle(const Way& p, const Way& a, const Way& b, const Way& c) {
  return meets_in_plane(volume(p, a, b, c), [&](double t) {
    return geometry::closest_point_on_triangle(p.at(t), a.at(t), b.at(t), c.at(t)).squared_distance <
           kMeeting_m * kMeeting_m;
  });
}

std::int64_t count_crossings(const GutParts& parts, std::span<const Vec3> from, std::span<const Vec3> to,
                             std::int64_t& pairs) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<double> ways;
  for (const auto& masses : parts.masses) {
    boxes.push_back(swept(masses, from, to));
    ways.push_back(longest_way(masses, from, to));
  }
  std::int64_t crossings = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(parts.layout.segment_count()); ++i) {
    for (std::size_t j = i + 1; j < parts.masses.size(); ++j) {
      if (!parts.may_touch(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j))) continue;
      ++pairs;
      if (!boxes[i].intersects(boxes[j])) continue;
      const double both = (1 + kWayRounding) * (ways[i] + ways[j]) + kMeeting_m;
      if (squared_distance(parts.masses[i], parts.masses[j], from) > both * both) continue;
      crossings += parts_meet(parts.masses[i], parts.masses[j], from, to) ? 1 : 0;
    }
  }
  return crossings;
}

}  // namespace omentum::physics
