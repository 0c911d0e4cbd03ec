#include "render_node/few_triangles.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace omentum::render {
namespace {

constexpr float kWorth = 0.7f;  // of the triangles: lists that save less are left out

// Cube and octant of the normal. Coordinates near 0 would fall to either side by rounding: cubes and octants
// are set off by what no symmetric shape has.
std::array<int, 4> cluster_of(const Vertex& vertex, float side_m) {
  constexpr float kOff = 0.27f, kOffNormal = 0.031f;
  std::array<int, 4> cluster{};
  for (int c = 0; c < 3; ++c) {
    cluster[static_cast<std::size_t>(c)] = static_cast<int>(std::floor(vertex.position[c] / side_m + kOff));
    cluster[3] = 2 * cluster[3] + (vertex.normal[c] > kOffNormal ? 1 : 0);
  }
  return cluster;
}

// Not so: a triangle without area, or one that moving its corners turned over.
bool faces_out(const MeshData& mesh, const MeshTriangle& t) {
  const Vertex &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const Vec3f area = (b.position - a.position).cross(c.position - a.position);
  return area.dot(a.normal + b.normal + c.normal) > 0;
}

}  // namespace

void add_few_triangles(MeshData& mesh, float side_m) {
  std::map<std::array<int, 4>, std::uint32_t> first;
  std::vector<std::uint32_t> stands_for;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    stands_for.push_back(first.try_emplace(cluster_of(mesh.vertices[v], side_m), v).first->second);
  mesh.few.clear();
  for (const auto& [a, b, c] : mesh.triangles) {
    const MeshTriangle t{stands_for[a], stands_for[b], stands_for[c]};
    if (faces_out(mesh, t)) mesh.few.push_back(t);
  }
  if (static_cast<float>(mesh.few.size()) > kWorth * static_cast<float>(mesh.triangles.size()))
    mesh.few.clear();
}

}  // namespace omentum::render
