// Whether what an organ file says can be: its hash has no key, so that anybody can write one that matches.
#pragma once

#include "organ/organ.h"

namespace omentum::organ {

/// Throws geometry::InputError, naming the dataset and its row, unless all sizes and indices of `organ`
/// agree: tetrahedra of the mesh's nodes with a positive volume, finite positions, ascending numbers of the
/// mesh file, supports of three components, materials in range, regions that have tetrahedra, triangles each
/// on a face of the tetrahedron behind it that together close, fans that are the triangles' own, and the
/// pinned nodes last. O(N + T + F log F).
void require_consistent(const Organ& organ, const std::filesystem::path& file);

/// Throws geometry::InputError, beginning with `where`, for a material that no elastic solid has.
void require_materials(const physics::MaterialMap& material, const std::string& where);

}  // namespace omentum::organ
