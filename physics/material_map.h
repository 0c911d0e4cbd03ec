// Which material each tetrahedron of a mesh is of.
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/material.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace omentum::physics {

/// The tetrahedra whose region has this label are of this material.
struct RegionMaterial {
  std::int32_t label = 0;
  Material material;
};

/// One material for a whole mesh, and others for some of its regions.
struct MaterialMap {
  MaterialMap() = default;
  /// Implicit: a material alone is that of all tetrahedra.
  MaterialMap(const Material& everywhere, std::vector<RegionMaterial> own = {})
      : common(everywhere), regions(std::move(own)) {}

  Material common;                      // where the region has none of its own
  std::vector<RegionMaterial> regions;  // by label, ascending, each once

  /// That of tetrahedron `t`. Precondition: `mesh` has labels where there are regions.
  const Material& of(const geometry::TetraMesh& mesh, geometry::TetId t) const;
};

}  // namespace omentum::physics
