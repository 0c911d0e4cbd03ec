// How far tissue is stretched along its surface, and the colours that say so.
#pragma once

#include "geometry/surface.h"
#include "render_node/renderer.h"

#include <array>

namespace omentum::render {

/// The largest change of length in each node's surroundings, as a share: max |lambda - 1| over the principal
/// stretches lambda of its triangles, mean by their areas at rest. lambda^2 are the eigenvalues of F^T F with
/// F the map from a triangle's plane at rest to where it is; rigid motion gives 0. Of the surface alone: what
/// happens across it no state tells. 0 where a node has no triangle. All spans: [S].
void surface_strain(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> rest,
                    std::span<const Vec3f> positions, std::span<float> strain);

/// The map's scale: kStrainColours from 0 to kFullStrain, evenly spaced; beyond, the last one. Linear
/// colours, each lighter than the one before it, so that it reads without colour vision too.
inline constexpr float kFullStrain = 0.3f;  // soft tissue fails not far above
inline constexpr std::size_t kStrainColourCount = 5;
const std::array<Vec3f, kStrainColourCount>& strain_colours();

}  // namespace omentum::render
