// The skin of an intestine as a surface that patches are chosen of.
#pragma once

#include "deform_node/gut_presses.h"
#include "geometry/gut_skin.h"

#include <algorithm>
#include <span>

namespace omentum::deform {

/// The skin as it lies. Where it is folded, on the inner side of a sharp bend, it has no faces, but for those
/// that the tool's jaws hold: a loop bends where it is pulled, and jaws do not lose what they hold by that.
struct SkinFaces {
  // below this a triangle is folded up, where the gut bends sharply, and no place to touch, m^2
  static constexpr double kLeastArea_m2 = 1e-6;
  // of one that jaws hold: enough to have a normal, m^2
  static constexpr double kLeastGrasped_m2 = 1e-9;

  const geometry::GutSkin& skin;
  std::span<const geometry::Vec3> places, x;  // [nodes] of the skin, [masses], m
  const GutPresses& presses;
  std::uint32_t tool;

  std::size_t count() const noexcept { return skin.triangles().size(); }
  const auto& corners(std::size_t f) const noexcept { return skin.triangles()[f]; }
  const geometry::Vec3& place(geometry::NodeId n) const noexcept {
    return places[static_cast<std::size_t>(n)];
  }
  bool is_grasped(std::size_t f) const noexcept {
    return std::ranges::all_of(corners(f), [&](geometry::NodeId n) { return presses.grasps(tool, n); });
  }
  bool is_one(std::size_t f) const noexcept {
    const auto& [a, b, c] = corners(f);
    const geometry::Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a));
    if (is_grasped(f)) return normal.norm() > 2 * kLeastGrasped_m2;
    if (!(normal.norm() > 2 * kLeastArea_m2)) return false;
    return std::ranges::all_of(corners(f), [&](geometry::NodeId n) {
      const geometry::Vec3 out = place(n) - weighted(skin.node(n), x);
      return out.isZero() || normal.dot(out) > 0;
    });
  }
};

}  // namespace omentum::deform
