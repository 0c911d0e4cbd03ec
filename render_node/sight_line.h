// Whether something stands between the eye and a point.
#pragma once

#include "geometry/types.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// Whether a triangle of the mesh, from either side, is met on the way from `eye` to what is `margin_m` short
/// of `target` (all in W, m): what lies on a surface is not hidden by it.
bool hides(const MeshData& mesh, const Mat4f& W_from_mesh, const geometry::Vec3& eye,
           const geometry::Vec3& target, double margin_m);

}  // namespace omentum::render
