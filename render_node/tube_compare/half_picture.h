// Two tubes in one picture, and the processor's time that each takes.
#pragma once

#include "render_node/renderer.h"

#include "geometry/types.h"

namespace omentum::render::trial {

/// Of either half.
inline constexpr Size kHalf{800, 800};

/// From above; a share of the masses, all of whose wall is seen.
Frame seen_from_above(std::span<const geometry::Vec3> axis);
Picture draw(Renderer& renderer, const Frame& frame);
/// Of equal heights.
Picture side_by_side(const Picture& left, const Picture& right);
/// Of this thread, us: what other programs take does not count.
double cpu_us();

}  // namespace omentum::render::trial
