#include "organ/tied_split.h"

#include "geometry/touching_faces.h"

#include <algorithm>
#include <map>
#include <set>

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::NodeId;
using geometry::TriangleId;
using Nodes = std::array<NodeId, 3>;

Nodes sorted(Nodes nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

// Triangles of a part's surface by their nodes in the whole.
std::map<Nodes, TriangleId> triangles_of(const physics::MeshPart& part, const geometry::Surface& surface) {
  std::map<Nodes, TriangleId> found;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const auto at = [&](std::size_t i) { return part.node[surface.node[surface.triangles[f][i]]]; };
    found.emplace(sorted({at(0), at(1), at(2)}), TriangleId(f));
  }
  return found;
}

geometry::CoveredFace covered_face(const physics::MeshPart& part, const geometry::Surface& surface,
                                   TriangleId f) {
  const geometry::TetId own = surface.tetrahedron[f];
  const geometry::Tetrahedron& nodes = part.mesh.tetrahedra[own];
  const auto is_on_it = [&](NodeId n) {
    return std::ranges::any_of(surface.triangles[f],
                               [&](geometry::SurfaceId s) { return surface.node[s] == n; });
  };
  int corner = 0;
  while (is_on_it(nodes[static_cast<std::size_t>(corner)])) ++corner;
  return {part.tetrahedron[own], corner, {}};
}

// What lies on the precomputed part's faces may be cut away; what they lie on is never bared by that.
std::vector<geometry::CoveredFace> covered_of(const OrganSplit& split, const geometry::Surface& boundary,
                                              const std::vector<TriangleId>& of_dynamic) {
  const auto& [precomputed, dynamic, connection] = split.parts;
  const geometry::BoundedMesh fine{precomputed.mesh, split.surface}, coarse{dynamic.mesh, boundary};
  const std::vector<TriangleId>& faces = split.tie->faces;
  const std::vector<std::vector<geometry::TetId>> behind = geometry::behind_of(fine, faces, coarse);
  std::vector<geometry::CoveredFace> covered;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    covered.push_back(covered_face(precomputed, split.surface, faces[i]));
    for (const geometry::TetId t : behind[i]) covered.back().by.push_back(dynamic.tetrahedron[t]);
  }
  for (const TriangleId f : of_dynamic) covered.push_back(covered_face(dynamic, boundary, f));
  return covered;
}

void require_coarser(std::size_t dynamic, std::size_t precomputed, const std::string& where) {
  if (dynamic <= precomputed) return;
  throw InputError(where + "where the parts touch, the dynamic one has " + std::to_string(dynamic) +
                   " nodes and the precomputed one " + std::to_string(precomputed) +
                   ", which cannot hold them all; expected a dynamic part that is the coarser one there");
}

}  // namespace

void tie_split(OrganSplit& split, BorderFaces border, const std::string& where) {
  if (!split.parts.connection.empty())
    throw InputError(where + "the parts share nodes beside the faces that touch; expected one or the other");
  const geometry::Surface boundary = geometry::extract_surface(split.parts.dynamic.mesh, {});
  const auto fine = triangles_of(split.parts.precomputed, split.surface);
  const auto coarse = triangles_of(split.parts.dynamic, boundary);
  std::vector<TriangleId> faces, of_dynamic;
  std::set<NodeId> led_by;
  for (const Nodes& nodes : border) {
    if (const auto found = fine.find(sorted(nodes)); found != fine.end()) {
      faces.push_back(found->second);
    } else if (const auto also = coarse.find(sorted(nodes)); also != coarse.end()) {
      of_dynamic.push_back(also->second);
      led_by.insert(nodes.begin(), nodes.end());
    } else {
      throw InputError(where + "a face of the border is none of either part's surface");
    }
  }
  if (faces.empty()) throw InputError(where + "no face of the precomputed part is at the border");
  for (std::vector<TriangleId>* list : {&faces, &of_dynamic}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  split.tie = physics::tie_border(split.parts, split.surface, boundary, std::move(faces));
  require_coarser(led_by.size(), split.tie->slaves.size(), where);
  split.covered = covered_of(split, boundary, of_dynamic);
  split.border = std::move(border);
  split.connection = split.tie->slaves;
}

}  // namespace omentum::organ
