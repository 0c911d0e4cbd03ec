// The camera of indent.png: near to a dent and flat over the surface, so that its profile shows.
#pragma once

#include "render_node/camera.h"
#include "render_node/dent.h"

namespace omentum::render {

/// A straight shaft, from its tip towards its handle (unit), in W.
struct Shaft {
  Vec3 tip = Vec3::Zero();
  Vec3 towards_handle = Vec3::UnitZ();
};

/// Looks at the dent from a side from which it is seen: neither through tissue nor from under the table (the
/// plane z = `ground_m`), if there is such a side; as flat as can be, past the shafts, and otherwise as near
/// as can be to where `familiar` looks from. Upright along the surface's normal. `organs`: as
/// they are drawn now; `shafts`: of all tools that are drawn. Costs some passes over the drawn triangles.
Camera close_up_of(const Dent& dent, std::span<const MeshData* const> organs, std::span<const Shaft> shafts,
                   const Camera& familiar, double ground_m);

}  // namespace omentum::render
