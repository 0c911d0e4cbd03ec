#include "geometry/surface.h"

#include "geometry/precondition.h"
#include "geometry/tetra_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace omentum::geometry {
namespace {

struct BoundaryFace {
  std::array<NodeId, 3> nodes;  // outward
  TetId tetrahedron;
};

// Faces of exactly one tetrahedron.
std::vector<BoundaryFace> boundary_faces(const TetraMesh& mesh) {
  struct Side {
    std::array<NodeId, 3> sorted;
    BoundaryFace face;
  };
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const Tetrahedron& v = mesh.tetrahedra[t];
    for (const auto& [a, b, c] : kFaceOpposite) {
      Side side{{v[a], v[b], v[c]}, {{v[a], v[b], v[c]}, TetId(t)}};
      std::sort(side.sorted.begin(), side.sorted.end());
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.sorted < b.sorted; });
  std::vector<BoundaryFace> faces;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i + 1 < sides.size() && sides[i].sorted == sides[i + 1].sorted) {
      ++i;
    } else {
      faces.push_back(sides[i].face);
    }
  }
  return faces;
}

using NodeRange = std::span<NodeId>;

// Orders a range of nodes so that each aligned run of kClusterSize is compact: halves it across its longest
// side at a multiple of the cluster size, again and again.
void order_spatially(NodeRange nodes, const std::vector<Vec3>& positions) {
  if (nodes.size() <= static_cast<std::size_t>(kClusterSize)) return;
  Vec3 low = positions[nodes[0]], high = low;
  for (const NodeId n : nodes) {
    low = low.cwiseMin(positions[n]);
    high = high.cwiseMax(positions[n]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t clusters = (nodes.size() + kClusterSize - 1) / kClusterSize;
  const std::size_t middle = (clusters + 1) / 2 * kClusterSize;
  std::nth_element(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(middle), nodes.end(),
                   [&](NodeId a, NodeId b) {
                     return std::pair(positions[a][axis], a) < std::pair(positions[b][axis], b);
                   });
  order_spatially(nodes.first(middle), positions);
  order_spatially(nodes.subspan(middle), positions);
}

void number_nodes(Surface& surface, const TetraMesh& mesh, const std::vector<BoundaryFace>& faces,
                  const std::vector<bool>& pinned) {
  std::vector<NodeId>& node = surface.node;
  for (const BoundaryFace& face : faces) node.insert(node.end(), face.nodes.begin(), face.nodes.end());
  std::sort(node.begin(), node.end());
  node.erase(std::unique(node.begin(), node.end()), node.end());
  const auto first_pinned =
      std::stable_partition(node.begin(), node.end(), [&](NodeId n) { return pinned.empty() || !pinned[n]; });
  surface.mobile_count = static_cast<std::int32_t>(first_pinned - node.begin());
  const auto mobile = static_cast<std::size_t>(surface.mobile_count);
  order_spatially(NodeRange(node).first(mobile), mesh.positions);
  order_spatially(NodeRange(node).subspan(mobile), mesh.positions);
  surface.of_node.resize(mesh.positions.size());
  for (std::size_t s = 0; s < node.size(); ++s) surface.of_node[node[s]] = SurfaceId(s);
}

// Triangles in the order of their smallest node, which they start with: neighbours in space stay close in
// memory.
void number_triangles(Surface& surface, const std::vector<BoundaryFace>& faces) {
  std::vector<std::pair<Triangle, TetId>> ordered;
  for (const BoundaryFace& face : faces) {
    Triangle t = {surface.of_node[face.nodes[0]], surface.of_node[face.nodes[1]],
                  surface.of_node[face.nodes[2]]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    ordered.emplace_back(t, face.tetrahedron);
  }
  std::sort(ordered.begin(), ordered.end());
  for (const auto& [triangle, tetrahedron] : ordered) {
    surface.triangles.push_back(triangle);
    surface.tetrahedron.push_back(tetrahedron);
  }
}

void collect_fans(Surface& surface) {
  surface.fan_start.assign(surface.node.size() + 1, 0);
  for (const Triangle& t : surface.triangles) {
    for (const SurfaceId s : t) ++surface.fan_start[static_cast<std::size_t>(s) + 1];
  }
  std::partial_sum(surface.fan_start.begin(), surface.fan_start.end(), surface.fan_start.begin());
  surface.fan.resize(3 * surface.triangles.size());
  std::vector<std::int32_t> next(surface.fan_start.begin(), surface.fan_start.end() - 1);
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (const SurfaceId s : surface.triangles[f])
      surface.fan[static_cast<std::size_t>(next[s]++)] = TriangleId(f);
  }
}

}  // namespace

Surface extract_surface(const TetraMesh& mesh, const std::vector<bool>& pinned) {
  require(pinned.empty() || pinned.size() == mesh.positions.size(), "a flag for each node, or none");
  Surface surface;
  const std::vector<BoundaryFace> faces = boundary_faces(mesh);
  number_nodes(surface, mesh, faces, pinned);
  number_triangles(surface, faces);
  collect_fans(surface);
  return surface;
}

Surface surface_of_triangles(std::int32_t node_count, std::vector<Triangle> triangles) {
  Surface surface;
  for (std::int32_t n = 0; n < node_count; ++n) {
    surface.node.emplace_back(n);
    surface.of_node.emplace_back(n);
  }
  surface.triangles = std::move(triangles);
  surface.mobile_count = node_count;
  collect_fans(surface);
  return surface;
}

std::vector<Vec3> surface_positions(const TetraMesh& mesh, const Surface& surface) {
  std::vector<Vec3> positions;
  positions.reserve(surface.node.size());
  for (const NodeId n : surface.node) positions.push_back(mesh.positions[n]);
  return positions;
}

std::vector<Vec3> surface_normals(const Surface& surface, std::span<const Vec3> positions) {
  std::vector<Vec3> normals(positions.size(), Vec3::Zero());
  const auto at = [positions](SurfaceId s) -> const Vec3& { return positions[static_cast<std::size_t>(s)]; };
  for (const Triangle& t : surface.triangles) {
    // as long as twice the triangle's area
    const Vec3 n = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    for (const SurfaceId s : t) normals[static_cast<std::size_t>(s)] += n;
  }
  for (Vec3& n : normals) n.normalize();
  return normals;
}

}  // namespace omentum::geometry
