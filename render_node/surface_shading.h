// What light needs to know of a deforming surface: smooth normals and how open each point lies.
#pragma once

#include "geometry/surface.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// Outward unit normals at the nodes, weighted by the triangles' areas. `positions`, `normals`: [S].
/// A node without area around it keeps its normal.
void smooth_normals(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                    std::span<Vec3f> normals);

/// The fraction of ambient light that reaches each node, from the bend of the surface alone: 1 where it is
/// flat or bulges, less in a hollow (the mean rise of the neighbours over the tangent plane is the sine of
/// the horizon). Not occlusion by what is far away. `openness`: [S], in [kDeepest, 1].
void openness_of(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                 std::span<const Vec3f> normals, std::span<float> openness);

inline constexpr float kDeepestOpenness = 0.35f;  // light that scatters into any hollow of wet tissue

}  // namespace omentum::render
