// Pieces that instruments are put together of, and what they are made of.
#pragma once

#include "render_node/solids.h"

namespace omentum::render {

extern const Material kSteel, kDarkSteel, kInsulation, kCeramic, kGlass;
Material painted(const Vec3f& colour);

/// How round turned pieces of an instrument are.
inline constexpr int kTurnSegments = 28;

/// A cylinder about z with slightly broken edges, m.
MeshData sleeve(float radius, float from, float to);
/// A sleeve that lies on a shaft: in the coarsest pictures (`few`) all of its outside and nothing else, since
/// one of fewer corners would dip into the shaft; and at least `few_width` wide there, m, since what is
/// narrower than their pixels falls apart into dots.
MeshData ring(float radius, float from, float to, float few_width = 0);
/// A hemisphere about z, its pole at z = 0, and a cylinder on it up to `to`, m.
MeshData round_tip(float radius, float to);
/// A cylinder with round ends around both points, `segments` around it, m.
MeshData capsule(const Vec3f& from, const Vec3f& to, float radius, int segments);

/// With the few triangles of both, where `mesh` has some.
void append(const MeshData& mesh, MeshData& to);
/// Moved and turned, not scaled.
MeshData moved(const Mat4f& pose, MeshData mesh);

/// Rings of equally many points, each closed, from one end to the other, which are closed by `first_cap` and
/// `last_cap`: triangles of places in their ring. Counter-clockwise seen along the way from ring to ring.
MeshData skin_of_rings(const std::vector<std::vector<Vec3f>>& rings,
                       const std::vector<MeshTriangle>& first_cap, const std::vector<MeshTriangle>& last_cap);

}  // namespace omentum::render
