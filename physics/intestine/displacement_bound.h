// How far a mass may go in a step, so that nothing can pass through anything.
#pragma once

#include "geometry/types.h"

#include <cstdint>
#include <span>

namespace omentum::physics {

/// Of the distance between two parts each side may use up in a step. Together that is 0.9: what was apart
/// stays apart, whatever the directions (after the conservative bounds of offset geometric contact, Chen et
/// al., SIGGRAPH 2025). What of them is between two masses moves no farther than the farther of these.
constexpr double kShareOfGap = 0.45;

/// Takes back x to at most kShareOfGap times gap_m from where it was; v follows: what it was `before` this
/// way, and (x - before) / step_s. A place or velocity that is not finite becomes the old one. Sets `held` to
/// 1 for each mass that it took back. All [masses], v_before too, or empty: none; gap_m >= 0.
void bound_displacements(std::span<const geometry::Vec3> before, std::span<const geometry::Vec3> v_before,
                         std::span<const double> gap_m, double step_s, std::span<geometry::Vec3> x,
                         std::span<geometry::Vec3> v, std::span<std::uint8_t> held) noexcept;

}  // namespace omentum::physics
