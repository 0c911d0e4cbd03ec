// The drawn surface of a deforming organ.
#pragma once

#include "render_node/surface_refinement.h"

namespace omentum::render {

/// From displacements of the surface's nodes to lit vertices.
class OrganSkin {
 public:
  /// `rest`: [S], m, in the surface's order.
  OrganSkin(const geometry::Surface& surface, std::span<const geometry::Vec3> rest);

  /// `displacements`: [3S], x, y, z of each node, m.
  void deform(std::span<const float> displacements);

  const MeshData& mesh() const { return mesh_; }
  std::int32_t node_count() const { return static_cast<std::int32_t>(rest_.size()); }
  Vec3f position(geometry::SurfaceId node) const { return positions_[node]; }
  Vec3f normal(geometry::SurfaceId node) const { return normals_[node]; }
  Vec3f rest(geometry::SurfaceId node) const { return rest_[node]; }
  Vec3f rest_normal(geometry::SurfaceId node) const { return rest_normals_[node]; }
  /// The largest displacement of any node, m: what linear elasticity must be small against (dents: dent.h).
  double largest_displacement_m() const { return largest_displacement_m_; }
  /// The longest side of the box around the rest surface, m: "mesh size" in the limit of linearity.
  double extent_m() const { return extent_m_; }

 private:
  std::vector<geometry::Triangle> triangles_;
  std::vector<Vec3f> rest_, rest_normals_, positions_, normals_;  // [S]
  std::vector<float> openness_;                                   // [S]
  SurfaceRefinement refinement_;
  MeshData mesh_;
  double largest_displacement_m_ = 0;
  double extent_m_ = 0;
};

}  // namespace omentum::render
