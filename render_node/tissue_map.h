// Organs as a map of what their tissue is under: which, and the colours and scale that say how much.
#pragma once

#include "render_node/renderer.h"

#include <array>
#include <string_view>

namespace omentum::render {

/// The values are those of OrganStress (idl/organ.idl).
enum class TissueMap : std::uint8_t { kOff, kStrain, kStress };

/// The next one of a person who switches through them.
TissueMap next(TissueMap map);
/// "off", "strain" or "stress".
std::string_view word(TissueMap map);

/// The scale ends here for every organ and moment: one that follows the largest value shows the same colours
/// at rest and at tearing. What is compressed has the first colour.
inline constexpr float kFullStrain = 0.3f;  // soft tissue fails not far above
/// Of stress: what a bar has that is pulled to the full strain, of the stiffest of the organs, Pa.
double full_stress_pa(double largest_young_pa);

/// From 0 to the full scale, evenly spaced; beyond, the last one. Linear colours, each lighter than the one
/// before it, so that they read without colour vision too.
inline constexpr std::size_t kMapColourCount = 5;
const std::array<Vec3f, kMapColourCount>& map_colours();

}  // namespace omentum::render
