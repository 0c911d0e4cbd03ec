// A piece of an organ's surface around a place.
#pragma once

#include "geometry/surface.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace omentum::test {

struct OrganPatch {
  std::vector<geometry::SurfaceId> nodes;
  std::vector<std::array<std::uint8_t, 3>> triangles;  // places in `nodes`, outward
};

/// Of the `most` mobile nodes that are nearest to `place` those that triangles among them have as corners.
inline OrganPatch nearest_patch(const geometry::Surface& surface, std::span<const geometry::Vec3> positions,
                                const geometry::Vec3& place, std::size_t most) {
  std::vector<geometry::SurfaceId> nearest;
  for (std::int32_t n = 0; n < surface.mobile_count; ++n) nearest.emplace_back(n);
  const auto squared_m = [&](geometry::SurfaceId n) {
    return (positions[static_cast<std::size_t>(n)] - place).squaredNorm();
  };
  std::ranges::sort(nearest, {}, squared_m);
  nearest.resize(std::min(nearest.size(), most));
  OrganPatch patch;
  for (const geometry::Triangle& t : surface.triangles) {
    const auto is_near = [&](geometry::SurfaceId n) {
      return std::ranges::find(nearest, n) != nearest.end();
    };
    if (!std::ranges::all_of(t, is_near)) continue;
    std::array<std::uint8_t, 3> corners;
    for (std::size_t v = 0; v < 3; ++v) {
      auto at = std::ranges::find(patch.nodes, t[v]);
      if (at == patch.nodes.end()) at = patch.nodes.insert(at, t[v]);
      corners[v] = static_cast<std::uint8_t>(at - patch.nodes.begin());
    }
    patch.triangles.push_back(corners);
  }
  return patch;
}

}  // namespace omentum::test
