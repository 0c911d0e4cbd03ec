// A beam of tissue, held at one end and precomputed from there on, with masses in its other part.
#pragma once

#include "physics/direct_solve.h"
#include "physics/hybrid/hybrid_step.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/support/meshes.h"
#include "tests/support/tensors.h"

namespace omentum::test {

inline constexpr physics::Material kBeamTissue{5000, 0.4, 1050};

struct HybridBeam {
  geometry::TetraMesh mesh = make_box_mesh(8, 2, 2, {0.12, 0.03, 0.03});
  physics::MaterialMap material;
  std::vector<std::uint8_t> dynamic;  // where x > 6 cm
  physics::MeshSplit split;
  physics::Inertia inertia;
  physics::FixedComponents fixed;  // of the precomputed part
  geometry::Surface surface;       // likewise
  physics::SurfaceCompliance compliance{0, nullptr, nullptr, nullptr};
  Values weights;

  /// `stiffer`: what Young's modulus of the precomputed part is in that of the dynamic one.
  explicit HybridBeam(const geometry::Vec3& gravity = {0, 0, -9.81}, double stiffer = 1)
      : material(kBeamTissue,
                 {{1, {stiffer * kBeamTissue.young_pa, kBeamTissue.poisson, kBeamTissue.density_kg_m3}}}) {
    for (const auto& t : mesh.tetrahedra) {
      double x = 0;
      for (const geometry::NodeId n : t) x += mesh.positions[n].x() / 4;
      dynamic.push_back(x > 0.06 ? 1 : 0);
      mesh.regions.push_back(x > 0.06 ? 0 : 1);
    }
    split = physics::split_mesh(mesh, dynamic);
    inertia.mass = physics::lumped_masses(mesh, material);
    for (const geometry::Vec3& p : mesh.positions) inertia.fixed.push_back(p.x() == 0 ? physics::kPinned : 0);
    fixed = physics::supports_of(split.precomputed, inertia.fixed);
    surface = geometry::extract_surface(split.precomputed.mesh, physics::pinned_nodes(fixed));
    compliance = tensors_of(physics::assemble_stiffness(split.precomputed.mesh, material), fixed, surface);
    for (const geometry::Vec3& f : physics::body_forces(mesh, material, gravity))
      weights.insert(weights.end(), f.begin(), f.end());
  }

  physics::HybridBody body() const { return {split, surface, compliance, material, fixed, inertia, weights}; }
  std::size_t components() const { return 3 * mesh.positions.size(); }
  /// Neither held nor inside the precomputed part: where a hybrid step knows the displacement.
  bool is_known(std::size_t n) const {
    if (split.dynamic.own_node[n].valid()) return true;
    const geometry::SurfaceId s = surface.of_node[split.precomputed.own_node[n]];
    return s.valid() && s < surface.mobile_count;
  }
  geometry::NodeId nearest(const geometry::Vec3& place) const {
    std::size_t best = 0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n)
      if ((mesh.positions[n] - place).norm() < (mesh.positions[best] - place).norm()) best = n;
    return geometry::NodeId(best);
  }
  /// Beyond the largest component of `expected`, of what is known.
  double difference(const Values& found, const Values& expected) const {
    double size = 0, off = 0;
    for (std::size_t c = 0; c < found.size(); ++c) {
      if (!is_known(c / 3)) continue;
      size = std::max(size, std::abs(expected[c]));
      off = std::max(off, std::abs(found[c] - expected[c]));
    }
    return off / size;
  }
};

}  // namespace omentum::test
