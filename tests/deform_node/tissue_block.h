// Boxes of tissue with masses, held or free, that meet other organs.
#pragma once

#include "tests/deform_node/dynamic_beam.h"

namespace omentum::deform {

inline const Vec3 kDown(0, 0, -9.81);

/// Whether a place of the box, from its corner, is held.
using Held = bool (*)(const Vec3&);
inline bool below(const Vec3& x) {
  return x.z() < 1e-9;
}
inline bool at_the_left(const Vec3& x) {
  return x.x() < 1e-9;
}
inline bool nowhere(const Vec3&) {
  return false;
}

/// A box of tissue at a place, held below where it is asked for.
struct Block {
  geometry::TetraMesh mesh;
  physics::MaterialMap material{kTissue};
  physics::FixedComponents fixed;
  geometry::Surface surface;
  std::unique_ptr<DynamicModel> model;
  std::unique_ptr<geometry::MeshEditor> editor;

  Block(const std::array<int, 3>& cells, const Vec3& size, const Vec3& corner, Held is_held,
        const Vec3& gravity_m_s2, double step_s = kTick_s) {
    mesh = test::make_box_mesh(cells[0], cells[1], cells[2], size);
    for (Vec3& x : mesh.positions) {
      fixed.push_back(is_held(x) ? physics::kPinned : 0);
      x += corner;
    }
    surface = geometry::extract_surface(mesh, physics::pinned_nodes(fixed));
    const SteppedBody body{mesh,
                           material,
                           {.mass = physics::lumped_masses(mesh, material),
                            .fixed = fixed,
                            .mass_damping_per_s = 0,
                            .stiffness_damping_s = 0.01}};
    DynamicParts parts{.body = body, .uncut_surface = surface.node};
    parts.stepper = make_warped_stepper(body, step_s);
    parts.gravity_m_s2 = gravity_m_s2;
    parts.tears.resize(mesh.tetrahedra.size());
    parts.cut_rate_per_s = 1e6;
    model = std::make_unique<DynamicModel>(std::move(parts));
    editor =
        std::make_unique<geometry::MeshEditor>(mesh, geometry::EditorOptions{.uncut_surface = surface.node});
  }

  /// Where the node nearest to a place at rest is seen.
  Vec3 seen(NodeId n) const {
    editor->set_removed(model->view().removed_bits);
    return mesh.positions[n] +
           Eigen::Map<const Eigen::Vector3f>(model->view().values.data() + 3 * editor->surface_of(n))
               .cast<double>();
  }
  NodeId nearest(const Vec3& x) const {
    const auto less = [&](const Vec3& a, const Vec3& b) { return (a - x).norm() < (b - x).norm(); };
    return NodeId(static_cast<std::size_t>(
        std::min_element(mesh.positions.begin(), mesh.positions.end(), less) - mesh.positions.begin()));
  }
  double mass_kg() const {
    const std::vector<double> masses = physics::lumped_masses(mesh, material);
    return std::accumulate(masses.begin(), masses.end(), 0.0);
  }
  /// By what is seen.
  Vec3 first_moment() const {
    const std::vector<double> masses = physics::lumped_masses(mesh, material);
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < masses.size(); ++n) sum += masses[n] * seen(NodeId(n));
    return sum;
  }
};

}  // namespace omentum::deform
