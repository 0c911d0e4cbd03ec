#include "deform_node/patch_gatherer.h"

#include "geometry/closest_points.h"

#include <algorithm>

namespace omentum::deform {

using geometry::MeshEditor;
using geometry::NodeId;
using geometry::SurfaceFace;
using geometry::Vec3;

PatchGatherer::PatchGatherer(const geometry::TetraMesh& mesh, std::size_t most_nodes)
    : mesh_(mesh), most_nodes_(most_nodes), number_of_(mesh.positions.size(), -1) {
  near_.reserve(4 * mesh.tetrahedra.size());
  nodes_.reserve(most_nodes);
}

PatchGatherer::Places PatchGatherer::places_of(const SurfaceFace& face,
                                               std::span<const double> u) const noexcept {
  Places x;
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = mesh_.positions[face.nodes[i]] + Eigen::Map<const Vec3>(u.data() + 3 * face.nodes[i]);
  return x;
}

void PatchGatherer::find_near(const PatchPlace& place, const MeshEditor& editor,
                              std::span<const double> u) noexcept {
  near_.clear();
  const std::span<const SurfaceFace> faces = editor.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = places_of(faces[f], u);
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if (((low - place.centre).array() > place.radius_m).any()) continue;
    if (((place.centre - high).array() > place.radius_m).any()) continue;
    const double squared = geometry::closest_point_on_triangle(place.centre, a, b, c).squared_distance;
    if (squared <= place.radius_m * place.radius_m) near_.push_back({squared, f});
  }
  // those that are equally near in an order that does not depend on that of faces()
  std::ranges::sort(near_, [&](const Near& p, const Near& q) {
    if (p.squared_distance != q.squared_distance) return p.squared_distance < q.squared_distance;
    return faces[p.face].nodes < faces[q.face].nodes;
  });
}

bool PatchGatherer::has_room_for(const SurfaceFace& face) const noexcept {
  std::size_t fresh = 0;
  for (const NodeId n : face.nodes) fresh += number_of_[n] < 0;
  return nodes_.size() + fresh <= most_nodes_;
}

void PatchGatherer::number(const SurfaceFace& face) noexcept {
  for (const NodeId n : face.nodes) {
    if (number_of_[n] >= 0) continue;
    number_of_[n] = static_cast<std::int16_t>(nodes_.size());
    nodes_.push_back(n);
  }
}

bool PatchGatherer::gather(const PatchPlace& place, const MeshEditor& editor, std::span<const double> u,
                           LocalPatch& patch) noexcept {
  for (const NodeId n : nodes_) number_of_[n] = -1;
  nodes_.clear();
  find_near(place, editor, u);
  for (const Near& near : near_)
    if (has_room_for(editor.faces()[near.face])) number(editor.faces()[near.face]);
  patch.node_count = nodes_.size();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    patch.nodes[i] = static_cast<std::uint32_t>(mesh_.file_node[nodes_[i]]);
  patch.triangle_count = 0;
  for (const Near& near : near_) {
    const auto& nodes = editor.faces()[near.face].nodes;
    const bool is_inside = std::ranges::all_of(nodes, [&](NodeId n) { return number_of_[n] >= 0; });
    if (!is_inside || patch.triangle_count == patch.triangles.size()) continue;
    for (std::size_t i = 0; i < 3; ++i)
      patch.triangles[patch.triangle_count][i] = static_cast<std::uint8_t>(number_of_[nodes[i]]);
    ++patch.triangle_count;
  }
  return patch.node_count > 0;
}

}  // namespace omentum::deform
