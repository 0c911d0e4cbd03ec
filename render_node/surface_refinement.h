// Makes a coarse surface look smooth: Phong tessellation (Boubekeur and Alexa, ACM Transactions on Graphics
// 27(5), 2008).
#pragma once

#include "geometry/surface.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// Splits each triangle into level^2 and curves them:
///   p*(w) = (1 - alpha) p(w) + alpha sum_i w_i pi_i(p(w)),   pi_i(q) = q - ((q - p_i).n_i) n_i   (their eq.
///   2, 3)
/// with p(w) = sum_i w_i p_i. The nodes themselves stay where they are (contact stays exact), edges stay
/// closed.
class SurfaceRefinement {
 public:
  /// level >= 1; 1 leaves the surface as it is.
  SurfaceRefinement(std::span<const geometry::Triangle> triangles, std::int32_t node_count, int level);

  /// Where a refined vertex lies: in a triangle, on an edge (one weight is 0) or at a node (two are).
  struct Place {
    std::array<std::int32_t, 3> node;
    Vec3f weight;  // sums to 1
  };
  const std::vector<Place>& places() const { return places_; }  // the S nodes first
  std::size_t vertex_count() const { return places_.size(); }
  /// level^2 for each of the triangles that it was made of, in their order.
  const std::vector<MeshTriangle>& triangles() const { return triangles_; }

  /// Curved positions: `out` [vertex_count] from `positions` and `normals` [S].
  void curve(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<Vec3f> out) const;
  /// Everything that changes from frame to frame: position, normal, openness; `rest` is left alone.
  void apply(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
             std::span<const float> openness, std::span<Vertex> out) const;
  /// One value of each node, [S], to a field of the vertices.
  void spread(std::span<const float> of_nodes, float Vertex::*field, std::span<Vertex> out) const;
  /// The curved position of any place on the surface.
  static Vec3f curved(const Place& place, std::span<const Vec3f> positions, std::span<const Vec3f> normals);
  /// And of one vertex.
  Vec3f curved(std::size_t vertex, std::span<const Vec3f> positions, std::span<const Vec3f> normals) const;

 private:
  std::size_t node_count_ = 0;
  std::vector<Place> places_;
  std::vector<MeshTriangle> triangles_;
};

/// The level at which a surface of that many triangles looks smooth and software drawing stays cheap.
int refinement_level(std::size_t triangle_count);

}  // namespace omentum::render
