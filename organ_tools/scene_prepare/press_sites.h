// Where a simulated hand can press an organ that nobody has looked at.
#pragma once

#include "organ_tools/scene_prepare/organ_skin.h"

#include <vector>

namespace omentum::scene_prepare {

/// A place to press, and the way the instrument may then slide.
struct PressSite {
  Vec3 point;
  Vec3 normal;  // outward, unit
  Vec3 slide;   // tangential, unit
};

/// Chooses `slides_m.size()` sites, one per hand: on the upper face (+z; the face away from the supports
/// where those are above), far from the supports, flat, with room to slide slides_m[i] without coming to an
/// edge, and apart from each other. Deterministic. Throws geometry::InputError when no mobile node is left.
std::vector<PressSite> choose_press_sites(const OrganSkin& skin, const std::vector<double>& slides_m);

}  // namespace omentum::scene_prepare
