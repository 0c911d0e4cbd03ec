#include "physics/material_map.h"

#include <algorithm>

namespace omentum::physics {

const Material& MaterialMap::of(const geometry::TetraMesh& mesh, geometry::TetId t) const {
  if (regions.empty()) return common;
  const std::int32_t label = mesh.regions[static_cast<std::size_t>(t)];
  const auto found = std::ranges::lower_bound(regions, label, {}, &RegionMaterial::label);
  return found != regions.end() && found->label == label ? found->material : common;
}

}  // namespace omentum::physics
