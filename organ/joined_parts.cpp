#include "organ/joined_parts.h"

#include "geometry/touching_faces.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace omentum::organ {

namespace {

using geometry::BoundedMesh;
using geometry::InputError;
using geometry::NodeId;
using geometry::TetraMesh;

// Meshes of one border that were made apart differ by some hundredths of an edge.
constexpr double kGapInEdges = 0.05;

double mean_edge_m(const BoundedMesh& of) {
  double sum_m = 0;
  for (const geometry::Triangle& t : of.surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      sum_m += (of.mesh.positions[of.surface.node[t[i]]] - of.mesh.positions[of.surface.node[t[(i + 1) % 3]]])
                   .norm();
  return sum_m / static_cast<double>(3 * of.surface.triangles.size());
}

std::string millimetres(double m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * m);
  return text;
}

// As a file without numbers of its own counts.
std::vector<std::int64_t> numbers_of(const std::vector<std::int64_t>& own, std::size_t count) {
  if (!own.empty()) return own;
  std::vector<std::int64_t> counted(count);
  std::iota(counted.begin(), counted.end(), 0);
  return counted;
}

// The second file's numbers begin behind the largest of the first one's. Returns by how much they move.
std::int64_t append_numbers(std::vector<std::int64_t>& numbers, const std::vector<std::int64_t>& more) {
  const std::int64_t shift =
      numbers.empty() ? 0 : *std::ranges::max_element(numbers) + 1 - *std::ranges::min_element(more);
  for (const std::int64_t n : more) numbers.push_back(n + shift);
  return shift;
}

void append_regions(TetraMesh& mesh, const TetraMesh& more) {
  if (mesh.regions.empty() || more.regions.empty()) {
    mesh.regions.clear();
    mesh.why_no_regions = "not both meshes of a hybrid organ have labels";
    return;
  }
  mesh.regions.insert(mesh.regions.end(), more.regions.begin(), more.regions.end());
}

void append(const TetraMesh& more, JoinedParts& joined) {
  TetraMesh& mesh = joined.mesh;
  const auto first = static_cast<std::int32_t>(mesh.positions.size());
  const std::int32_t first_file = mesh.file_node_count;
  append_regions(mesh, more);
  joined.node_shift = append_numbers(
      mesh.node_numbers, numbers_of(more.node_numbers, static_cast<std::size_t>(more.file_node_count)));
  joined.tetrahedron_shift =
      append_numbers(mesh.tetrahedron_numbers, numbers_of(more.tetrahedron_numbers, more.tetrahedra.size()));
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (geometry::Tetrahedron t : more.tetrahedra) {
    for (NodeId& n : t) n = NodeId(static_cast<std::int32_t>(n) + first);
    mesh.tetrahedra.push_back(t);
  }
  for (const std::int32_t n : more.file_node) mesh.file_node.push_back(n + first_file);
  for (const auto& [dropped, kept] : more.merged)
    mesh.merged.push_back({dropped + first_file, kept + first_file});
  mesh.file_node_count += more.file_node_count;
}

void add_border(const BoundedMesh& of, const std::vector<geometry::TriangleId>& faces, std::int32_t first,
                BorderFaces& border) {
  for (const geometry::TriangleId f : faces) {
    const auto at = [&](std::size_t i) {
      return NodeId(static_cast<std::int32_t>(of.surface.node[of.surface.triangles[f][i]]) + first);
    };
    border.push_back({at(0), at(1), at(2)});
  }
}

}  // namespace

JoinedParts join_parts(const TetraMesh& precomputed, const TetraMesh& dynamic, double gap_m,
                       const std::string& where) {
  const geometry::Surface fine = geometry::extract_surface(precomputed, {});
  const geometry::Surface coarse = geometry::extract_surface(dynamic, {});
  const BoundedMesh a{precomputed, fine}, b{dynamic, coarse};
  const double gap = gap_m > 0 ? gap_m : kGapInEdges * mean_edge_m(b);
  const double overlap = std::max(geometry::deepest_inside(a, b), geometry::deepest_inside(b, a));
  if (overlap > gap) {
    throw InputError(where + "the parts overlap by " + millimetres(overlap) +
                     "; expected meshes that lie on each "
                     "other to within " +
                     millimetres(gap));
  }
  const std::vector<geometry::TriangleId> faces = geometry::faces_on(a, b, gap);
  if (faces.empty()) {
    throw InputError(where +
                     "the parts do not touch: no face of the precomputed part's mesh lies on the dynamic "
                     "part's to within " +
                     millimetres(gap));
  }
  JoinedParts joined{precomputed, std::vector<std::uint8_t>(precomputed.tetrahedra.size(), 0), {}};
  joined.mesh.node_numbers =
      numbers_of(precomputed.node_numbers, static_cast<std::size_t>(precomputed.file_node_count));
  joined.mesh.tetrahedron_numbers =
      numbers_of(precomputed.tetrahedron_numbers, precomputed.tetrahedra.size());
  append(dynamic, joined);
  joined.dynamic.resize(joined.mesh.tetrahedra.size(), 1);
  add_border(a, faces, 0, joined.border);
  add_border(b, geometry::faces_on(b, a, gap), static_cast<std::int32_t>(precomputed.positions.size()),
             joined.border);
  return joined;
}

}  // namespace omentum::organ
