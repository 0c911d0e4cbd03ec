// The drawn surface of a deforming organ.
#pragma once

#include "render_node/surface_refinement.h"

namespace omentum::render {

/// From displacements of the surface's nodes to lit vertices. A tube (intestine) will be another
/// class beside this one with the same vertices() (DESIGN 3, rendering the tube).
class OrganSkin {
 public:
  /// `rest`: [S], m, in the surface's order.
  OrganSkin(const geometry::Surface& surface, std::span<const geometry::Vec3> rest);

  /// `displacements`: [3S], x, y, z of each node, m.
  void deform(std::span<const float> displacements);

  const MeshData& mesh() const { return mesh_; }
  Vec3f position(geometry::SurfaceId node) const { return positions_[node]; }
  Vec3f normal(geometry::SurfaceId node) const { return normals_[node]; }
  /// The largest displacement of any node, m.
  double deepest_m() const { return deepest_m_; }
  /// The longest side of the box around the rest surface, m: "mesh size" in DESIGN 3's limit of linearity.
  double extent_m() const { return extent_m_; }

 private:
  std::vector<geometry::Triangle> triangles_;
  std::vector<Vec3f> rest_, positions_, normals_;  // [S]
  std::vector<float> openness_;                    // [S]
  SurfaceRefinement refinement_;
  MeshData mesh_;
  double deepest_m_ = 0;
  double extent_m_ = 0;
};

}  // namespace omentum::render
