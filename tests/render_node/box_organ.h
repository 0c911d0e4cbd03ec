// An organ for the tests that can be cut: a box of tetrahedra, and cuts through it.
#pragma once

#include "render_node/scene_view.h"

#include "tests/support/meshes.h"

#include <functional>

namespace omentum::render::test {

/// A cube of so many cells along each side, six tetrahedra each, one corner at the origin.
inline constexpr double kBoxSide_m = 0.1;
inline OrganShape box_organ(int cells) {
  OrganShape shape;
  const auto mesh = std::make_shared<const geometry::TetraMesh>(
      omentum::test::make_box_mesh(cells, cells, cells, geometry::Vec3::Constant(kBoxSide_m)));
  shape.surface = geometry::extract_surface(*mesh, {});
  shape.rest = geometry::surface_positions(*mesh, shape.surface);
  shape.surface_of_file_node.resize(static_cast<std::size_t>(mesh->file_node_count));
  for (std::size_t n = 0; n < mesh->file_node.size(); ++n)
    shape.surface_of_file_node[static_cast<std::size_t>(mesh->file_node[n])] = shape.surface.of_node[n];
  shape.mesh = mesh;
  return shape;
}

/// What is left after cuts, as deform_node's books have it.
class Cutter {
 public:
  explicit Cutter(const OrganShape& shape)
      : mesh_(*shape.mesh), editor_(mesh_, {.uncut_surface = shape.surface.node}) {
    removed_.burnt.assign(editor_.removed_bits().size(), 0);
  }

  /// Removes the tetrahedra whose middle fulfils `where`, by a hot edge or by force.
  void cut(const std::function<bool(const geometry::Vec3&)>& where, bool hot = false) {
    std::vector<geometry::TetId> asked;
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      geometry::Vec3 middle = geometry::Vec3::Zero();
      for (const geometry::NodeId n : mesh_.tetrahedra[t]) middle += mesh_.positions[n] / 4;
      if (where(middle)) asked.emplace_back(t);
    }
    remove(asked, hot);
  }
  void remove(std::span<const geometry::TetId> asked, bool hot = false) {
    for (const geometry::TetId t : editor_.remove(asked).asked)
      if (hot) removed_.burnt[static_cast<std::size_t>(t) / 8] |= static_cast<std::uint8_t>(1u << t % 8);
    removed_.bits.assign(editor_.removed_bits().begin(), editor_.removed_bits().end());
  }
  const RemovedSet& removed() const { return removed_; }
  const geometry::MeshEditor& books() const { return editor_; }
  /// Displacements of a state: each node moved by `u` of its place.
  std::vector<float> state(const std::function<geometry::Vec3(const geometry::Vec3&)>& u) const {
    std::vector<float> values;
    for (const geometry::NodeId n : editor_.surface_nodes()) {
      const geometry::Vec3 moved = u(mesh_.positions[n]);
      for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(moved[c]));
    }
    return values;
  }
  std::vector<float> rest() const {
    return state([](const geometry::Vec3&) { return geometry::Vec3(geometry::Vec3::Zero()); });
  }

 private:
  const geometry::TetraMesh& mesh_;
  geometry::MeshEditor editor_;
  RemovedSet removed_;
};

/// A slit from above, half through the middle of the box.
inline bool in_slit(const geometry::Vec3& p) {
  return std::abs(p.x() - 0.5 * kBoxSide_m) < 0.13 * kBoxSide_m && p.z() > 0.5 * kBoxSide_m;
}

}  // namespace omentum::render::test
