// Regions of another material as a user writes them: where, and what of it differs.
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/material_map.h"

#include <span>
#include <string>

namespace omentum::organ {

/// The materials of an organ of `organ`'s, but for the regions that SPECs name; `mesh` gets their labels. A
/// SPEC is a list of KEY=VALUE between semicolons: one place,
///   label=2                    tetrahedra that the mesh file gives this label
///   box=x0,y0,z0,x1,y1,z1      those whose centre lies inside a box or on its faces, metres
///   ball=x,y,z,r               those whose centre is at most r from a point, metres
/// and one or more of young=PA, poisson=NU, density=KG_M3; what is left out is the organ's. A tetrahedron
/// that several SPECs name is of the last one. Boxes and balls get labels above all of the mesh's. Throws
/// geometry::InputError naming the SPEC for a wrong one, a material that no elastic solid has, a label that
/// was named before or that the mesh does not have, and a region without a tetrahedron of its own.
physics::MaterialMap parse_regions(std::span<const std::string> specs, const physics::Material& organ,
                                   geometry::TetraMesh& mesh);

}  // namespace omentum::organ
