// Random cuts of meshes, and the books of a cut mesh made from scratch, by no code that the editor shares.
#pragma once

#include "geometry/mesh_editor.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace omentum::geometry {

/// What differs between the editor's books and those made from scratch for the tetrahedra that it calls
/// removed: uses, faces, surface nodes and their places, pieces, counts; empty: nothing. `uncut`: the nodes
/// of the uncut surface in the order that the editor was given.
std::string difference_from_scratch(const MeshEditor& editor, const TetraMesh& mesh,
                                    std::span<const NodeId> uncut);

/// What is not manifold in the rest of the mesh, as check_mesh sees it; empty: nothing.
std::string not_manifold(const MeshEditor& editor, const TetraMesh& mesh);

/// One long sequence: single tetrahedra, strokes along lines, batches with numbers that are gone, repeated or
/// wrong, sets that another editor sent, restarts, with and without a smallest piece, at last all that is
/// left. Checks the books and the surface after every change. The first thing that is wrong, with the change
/// at which it was; empty: nothing.
std::string try_cut_sequence(const TetraMesh& mesh, std::uint32_t seed);

}  // namespace omentum::geometry
