// The one shape that all pieces of a skinned tube are: a cylinder between two frames.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// A corner of the undeformed cylinder (Raghupathi 2004, eq. 13). Uploaded as it lies in memory.
struct CylinderVertex {
  float cosine = 1, sine = 0;  // of its direction across, from k towards b
  float z = 0;                 // 0 at the first frame, 1 at the second one
  float direction = 0;         // the same direction, in steps of SkinFrame::walls
  float outwards = 1;          // of the radius: less on a cap
  float forward = 0;  // of the cap's depth: beyond the second frame, or, negative, before the first one
};
static_assert(sizeof(CylinderVertex) == 6 * sizeof(float), "uploaded as it lies in memory");

/// The wall, then the cap before the first frame, then the one beyond the second: vertices and triangles
/// alike.
struct TubeCylinder {
  static constexpr int kAround = 20;     // vertices of a section: its outline shows no corners
  static constexpr int kFewAround = 10;  // and hardly any where a pixel is as wide as nine
  static constexpr int kCapRings = 4;

  std::vector<CylinderVertex> vertices;
  std::vector<MeshTriangle> triangles;
  std::size_t wall_vertices = 0, wall_triangles = 0, cap_triangles = 0;  // cap_triangles: of one cap
};

/// With 2^(n+1) sections, evenly apart, of `around` vertices; 0 <= n.
TubeCylinder make_tube_cylinder(int n, int around = TubeCylinder::kAround);

/// Of a tube of so many frames, drawn with make_tube_cylinder(n): what a renderer's vertex shader works on.
TubeCost tube_cost(std::size_t frames, int n);

/// The share of the first frame in a vertex (eq. 14): 1 at z = 0, 0 at z = 1, slope 0 at both. And its
/// derivative by z.
float skin_weight(float z);
float skin_weight_slope(float z);

/// The wall of a tube of that radius, m: what gl/shaders/tube.glsl computes, computed here. With the matrices
///   M_1 = [r k_1, r b_1, ahead_1 t_1, o_1],  M_2 = [r k_2, r b_2, behind_2 t_2, o_2 - behind_2 t_2]
/// a vertex is w M_1 v + (1 - w) M_2 v. `ahead` and `behind` are half the axis' own slopes, so the middle
/// between the frames is the spline's own middle, and sections follow each other in the axis' direction at
/// every frame: neighbours share places and normals there. On the outer side of a bend the blend of both
/// directions across is made unit again: as it is, the wall would come in there by the cosine of half the
/// turn. Where the tube bends more tightly than it is wide its inner side gives way (give_way()).
Vertex skinned(const SkinFrame& first, const SkinFrame& second, float radius_m, const CylinderVertex& at);

/// How far out the wall is, of the radius, where the bend reaches `bend` = radius times curvature towards
/// there: 1 up to a moderate bend, then so that radius times bend stays below where sections would cross.
float give_way(float bend);

/// All of a tube, as it is drawn: pieces one after the other, with vertices of their own; closed where they
/// meet in place, not in number. For tests and pictures of it.
MeshData skinned_tube(std::span<const SkinFrame> frames, float radius_m, const TubeCylinder& cylinder);

}  // namespace omentum::render
