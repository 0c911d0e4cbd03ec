// The readers behind read_mesh, one per family of files. Each throws InputError as read_mesh says.
#pragma once

#include "geometry/tetra_mesh.h"

namespace omentum::geometry {

/// Gmsh 1 ($NOD/$ELM, ASCII), 2.x and 4.x (ASCII and binary).
RawMesh read_gmsh(const std::filesystem::path& file);

/// Legacy VTK, unstructured grid, ASCII and binary (big-endian, as the format prescribes).
RawMesh read_vtk_legacy(const std::filesystem::path& file);

/// VTK XML unstructured grid: ASCII, base64 and raw appended data, plain or with VTK's compressors.
RawMesh read_vtu(const std::filesystem::path& file);

/// TetGen's two files, .node and .ele, of which `file` is one; the other is found in capitals or not.
std::array<std::filesystem::path, 2> tetgen_pair(const std::filesystem::path& file);

/// TetGen's pair of files; `file` is either of them.
RawMesh read_tetgen(const std::filesystem::path& file);

}  // namespace omentum::geometry
