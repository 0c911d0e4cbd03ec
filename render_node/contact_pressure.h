// The pressure under tools, from forces at places to a field over a drawn surface.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// A force on the tissue at one node.
struct NodeForce {
  std::uint32_t file_node = 0;  // its place in the mesh file, from 0; of a gut's skin (geometry/gut_skin.h)
  Vec3f force_n;                // in W
};

/// A place where tissue is pressed: what of a force on it points inwards, N.
struct Press {
  Vec3f place;    // in W, m
  Vec3f outward;  // of the tissue there, unit
  float force_n = 0;
};

/// What of `force_n` on tissue presses it: nothing where it pulls.
Press press_of(const Vec3f& place, const Vec3f& outward, const Vec3f& force_n);

/// A force acts on more than a point: on what lies under the tip and bends around it. It is spread over the
/// surface that faces it by a weight that falls to nothing at the reach r:
///   p_j = sum_i f_i w_ij / sum_k A_k w_ik,   w_ij = (1 - |x_j - x_i|^2 / r^2)^2
/// with A_k the surface's area around vertex k at rest, so that sum_j A_j p_j = sum_i f_i however fine the
/// mesh is. One thread.
class ContactPressure {
 public:
  /// A tip of 4 mm radius and the dent's wall around it. A force inside a triangle comes as three at its
  /// corners: then their reach goes as far as to the nearest other one, up to kMostReach_m, so that it is
  /// felt most between them. Where a mesh is so coarse that no vertex lies in reach, kCoarseReach times the
  /// way to the nearest one.
  static constexpr float kReach_m = 0.0075f, kMostReach_m = 0.015f, kCoarseReach = 1.5f;

  /// Areas are those of the triangles between the vertices' `rest`. To be made anew when triangles change.
  explicit ContactPressure(const MeshData& mesh);

  /// Pa, at each vertex, which are as many as the mesh had; valid until the next call.
  std::span<const float> under(std::span<const Press> presses, std::span<const Vertex> vertices);
  float area_m2(std::size_t vertex) const { return area_m2_[vertex]; }

 private:
  void find_near(std::span<const Press> presses, std::span<const Vertex> vertices);
  void spread(const Press& press, float reach_m, std::span<const Vertex> vertices);
  bool faces(const Press& press, std::size_t vertex, std::span<const Vertex> vertices) const {
    return area_m2_[vertex] > 0 && vertices[vertex].normal.dot(press.outward) > 0;
  }

  std::vector<float> area_m2_, pressure_pa_;  // [V]
  std::vector<std::size_t> near_, all_;       // vertices that may be in reach of any press; all with an area
  std::vector<float> weight_;                 // of near_
};

}  // namespace omentum::render
