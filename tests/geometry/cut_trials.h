// Random cuts of meshes.
#pragma once

#include "geometry/tetra_mesh.h"

#include <cstdint>
#include <string>

namespace omentum::geometry {

/// One long sequence: single tetrahedra, strokes along lines, batches with numbers that are gone, repeated or
/// wrong, sets that another editor sent, restarts, with and without a smallest piece, at last all that is
/// left. Checks the books (books_from_scratch.h), the surface and the sizes of pieces after every change. The
/// first thing that is wrong, with the change at which it was; empty: nothing.
std::string try_cut_sequence(const TetraMesh& mesh, std::uint32_t seed);

}  // namespace omentum::geometry
