// What light needs to know of a deforming surface: smooth normals and how open each point lies.
#pragma once

#include "geometry/surface.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// Outward unit normals at the nodes, weighted by the triangles' areas. `positions`, `normals`: [S].
/// A node without area around it keeps its normal.
void smooth_normals(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                    std::span<Vec3f> normals);

/// The fraction of ambient light that reaches each node: 1 where the surface is flat or bulges, less where it
/// lies below its own surroundings. Those are the surface averaged over about `horizon_m` (diffused over the
/// edges); a hollow as deep below it as wide is dark. Not occlusion by what is far away. `openness`: [S], in
/// [kDeepestOpenness, 1].
void openness_of(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                 std::span<const Vec3f> normals, float horizon_m, std::span<float> openness);

inline constexpr float kDeepestOpenness = 0.35f;  // light that scatters into any hollow of wet tissue

}  // namespace omentum::render
