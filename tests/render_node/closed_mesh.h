// What every solid's mesh must hold to.
#pragma once

#include "render_node/renderer.h"

#include <map>
#include <utility>

namespace omentum::render::test {

/// Each edge is met once in each direction: no hole, no seam, all triangles the same way round.
inline bool is_closed(const MeshData& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    const auto other = edges.find({edge.second, edge.first});
    if (count != 1 || other == edges.end()) return false;
  }
  return !edges.empty();
}

/// Positive where triangles face outwards, m^3.
inline double volume_m3(const MeshData& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices[a].position.cast<double>();
    const Eigen::Vector3d q = mesh.vertices[b].position.cast<double>();
    volume += p.dot(q.cross(mesh.vertices[c].position.cast<double>())) / 6;
  }
  return volume;
}

/// A vector outward, as long as the triangle's area, m^2.
inline Vec3f area_of(const MeshData& mesh, const MeshTriangle& t) {
  const Vec3f& p = mesh.vertices[t[0]].position;
  return 0.5f * (mesh.vertices[t[1]].position - p).cross(mesh.vertices[t[2]].position - p);
}

/// Of the triangles that have an area, those that face away from a vertex's normal.
inline int flipped_triangles(const MeshData& mesh) {
  int count = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3f area = 2 * area_of(mesh, t);
    for (const auto corner : t) {
      if (area.norm() > 1e-10f && area.dot(mesh.vertices[corner].normal) < 0) {
        ++count;
        break;
      }
    }
  }
  return count;
}

inline bool all_finite(const MeshData& mesh) {
  for (const Vertex& v : mesh.vertices) {
    const Eigen::Array3f scalars(v.openness, v.charring, v.share);
    if (!v.position.allFinite() || !v.normal.allFinite() || !v.rest.allFinite() || !scalars.allFinite())
      return false;
  }
  return true;
}

}  // namespace omentum::render::test
