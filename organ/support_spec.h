// Supports as a user writes them: which nodes, which components.
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/supports.h"

#include <span>
#include <string>

namespace omentum::organ {

/// The union of what each SPEC holds, [N]. A SPEC is
///   plane:x<0.03               nodes on one side of a plane: axis x, y or z, then < or >, then metres
///   box:x0,y0,z0,x1,y1,z1      nodes inside a box or on its faces, metres
///   FILE.csv                   node numbers, one per line; of several columns a header names the one
///                              of nodes (node_column.h)
/// optionally followed by single components, such as ":xz"; without them a node is held in all three; or
/// several of the first two joined by "+", such as box:...+box:...:z. Numbers of nodes that no tetrahedron
/// uses hold nothing; that of a node that was merged into another one holds that one. Throws
/// geometry::InputError naming the SPEC (or file and line) for a wrong one, a node number that the mesh file
/// does not have, several columns without a header, and one that matches no node (with the mesh's extent).
physics::FixedComponents parse_supports(std::span<const std::string> specs, const geometry::TetraMesh& mesh,
                                        geometry::Numbering numbering = geometry::Numbering::kFile);

}  // namespace omentum::organ
