// What light needs to know of a surface: smooth normals and how open each point lies. Of one that deforms,
// state after state: shading_net.h.
#pragma once

#include "geometry/surface.h"
#include "render_node/renderer.h"

#include <algorithm>

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

/// How often openness_of() lets every node go to the mean of its neighbours; 0 where triangles have no edges.
int diffusion_steps(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                    float horizon_m);

inline constexpr float kDeepestOpenness = 0.35f;  // light that scatters into any hollow of wet tissue
/// Lost light per depth below the surroundings over the horizon: a sixth of the horizon deep, a third is
/// left. More than a hollow of that shape hides of the sky, for the instrument that pressed it stands over
/// it.
inline constexpr float kHollowDarkening = 4.0f;

/// Of a node so far below its surroundings.
inline float openness_below(float depth_m, float horizon_m) {
  return std::clamp(1 - kHollowDarkening * depth_m / horizon_m, kDeepestOpenness, 1.0f);
}

}  // namespace omentum::render
