// Whether anything of a gut passed through anything between two steps, found in another way than by
// distances.
#pragma once

#include "physics/intestine/gut_parts.h"

#include <span>

namespace omentum::test {

/// Places of one moving point, edge or triangle corner: at the start and at the end, straight in between.
struct Way {
  geometry::Vec3 from, to;
  geometry::Vec3 at(double t) const { return from + t * (to - from); }
};

/// Whether two edges, or a point and a triangle, meet on their ways. Their four points are in one plane at
/// the roots of a cubic; at each of these the two are looked at.
bool edges_meet(const Way& p, const Way& q, const Way& a, const Way& b);
bool point_meets_triangle(const Way& p, const Way& a, const Way& b, const Way& c);

/// Pairs of a segment and another part that may touch and met on the way; `pairs` counts how many there were.
std::int64_t count_crossings(const physics::GutParts& parts, std::span<const geometry::Vec3> from,
                             std::span<const geometry::Vec3> to, std::int64_t& pairs);

}  // namespace omentum::test
