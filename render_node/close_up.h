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

/// Looks at the dent from the side that hides it least: neither behind a bulge of the organ nor behind a
/// shaft, and otherwise as near as can be to where `familiar` looks from. Upright along the surface's normal.
/// `shafts`: of all tools that are drawn.
Camera close_up_of(const Dent& dent, const OrganSkin& skin, std::span<const Shaft> shafts,
                   const Camera& familiar);

}  // namespace omentum::render
