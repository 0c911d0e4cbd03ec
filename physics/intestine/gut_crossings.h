// Whether anything of a gut passed through anything between two steps: a count that shares nothing with what
// keeps it from doing so.
#pragma once

#include "physics/intestine/gut_parts.h"

#include <span>

namespace omentum::physics {

/// Places of one moving point, edge or triangle corner: at the start and at the end, straight in between.
struct Way {
  geometry::Vec3 from, to;
  geometry::Vec3 at(double t) const { return from + t * (to - from); }
};

/// Whether two edges, or a point and a triangle, meet on their ways. Their four points are in one plane at
/// the roots of a cubic; at each of these the two are looked at.
bool edges_meet(const Way& p, const Way& q, const Way& a, const Way& b);
bool point_meets_triangle(const Way& p, const Way& a, const Way& b, const Way& c);

/// Pairs of a segment and another part that may touch and met on the way; `pairs` grows by how many there
/// were. Looked at closely are those whose boxes around all of the way meet, and which were not farther from
/// each other at its start than both go. For checks, not for a step: it allocates.
std::int64_t count_crossings(const GutParts& parts, std::span<const geometry::Vec3> from,
                             std::span<const geometry::Vec3> to, std::int64_t& pairs);

}  // namespace omentum::physics
