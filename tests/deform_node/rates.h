// How often a test's organ ticks, where it does not matter.
#pragma once

namespace omentum::deform {

inline constexpr double kRate_hz = 100;
inline constexpr double kTick_s = 1 / kRate_hz;

}  // namespace omentum::deform
