// The dynamic part of a hybrid organ as a user writes it.
#pragma once

#include "geometry/tetra_mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace omentum::organ {

/// Which tetrahedra the SPECs name together, [T] of 0 and 1; empty without any SPEC. A SPEC is
///   plane:x<0.03               those whose centre lies on one side of a plane, metres (place_spec.h)
///   box:x0,y0,z0,x1,y1,z1      or inside a box or on its faces; + joins planes and boxes
///   label:N                    those that the mesh file gives this label
///   FILE.csv                   those whose numbers are listed (tetrahedra_csv.h)
/// Throws geometry::InputError naming the SPEC (or file and line) for a wrong one, a label that the mesh does
/// not have, and one that names no tetrahedron.
std::vector<std::uint8_t> parse_dynamic(std::span<const std::string> specs, const geometry::TetraMesh& mesh,
                                        geometry::Numbering numbering = geometry::Numbering::kFile);

}  // namespace omentum::organ
