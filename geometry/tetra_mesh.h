// A tetrahedral mesh whose input was checked: what every other room may rely on.
#pragma once

#include "geometry/element_kinds.h"
#include "geometry/file_numbers.h"
#include "geometry/types.h"

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace omentum::geometry {

/// Of nodes and of tetrahedra: their numbers have 32 bits, those of three components each too.
inline constexpr std::size_t kMostNodes = std::numeric_limits<std::int32_t>::max() / 3;

/// What a mesh file holds, before any check. Nodes and tetrahedra in the file's order, from 0.
struct RawMesh {
  std::string source;                                   // the file, for messages
  std::vector<Vec3> positions;                          // in the file's unit
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  // 0-based positions in `positions`: corners
  std::size_t curved = 0;                               // of them have nodes between their corners too
  ElementCounts others{};                               // elements that are no tetrahedra
  std::vector<std::int64_t> node_numbers{};             // the file's own, [positions]; empty: from 0
  std::vector<std::int64_t> tetrahedron_numbers{};      // the file's own, [tetrahedra]; empty: from 0
  std::vector<std::int32_t> regions{};                  // the file's label of each, [tetrahedra]; empty: none
  std::string why_no_regions{};                         // where the file has labels that cannot be used
};

/// A node of the file whose place another one takes; positions in the file, from 0.
struct MergedNode {
  std::int32_t dropped, kept;
};

/// A valid mesh: every node used, every tetrahedron positively oriented, no duplicate or overlapping
/// element, connected through faces, boundary closed and manifold. Positions in metres.
struct TetraMesh {
  std::vector<Vec3> positions;                    // [N], m
  std::vector<Tetrahedron> tetrahedra;            // [T], in the file's order
  std::vector<std::int32_t> file_node;            // [N], position in the mesh file, from 0
  std::int32_t file_node_count = 0;               // nodes in the file, unused ones included
  std::vector<std::int64_t> node_numbers;         // [file_node_count], what the file calls its nodes
  std::vector<std::int64_t> tetrahedron_numbers;  // [T], and its tetrahedra
  std::vector<MergedNode> merged;                 // by `dropped`, ascending; on demand only
  std::vector<std::int32_t> regions;              // [T], label of each tetrahedron's region; empty: none
  std::string why_no_regions;                     // a sentence, where the file's labels cannot be used

  /// The node of this mesh that each of the file's is, [file_node_count]: of a merged one, that which took
  /// its place; invalid where no tetrahedron uses it.
  std::vector<NodeId> nodes_of_file() const;

  /// What the nodes of the file are called, by position in it.
  FileNumbers names_of_nodes(Numbering numbering) const {
    return {node_numbers, static_cast<std::size_t>(file_node_count), numbering};
  }
};

/// Bad input: the message names file, place and expectation. Programs end with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CheckedMesh {
  TetraMesh mesh;
  std::vector<std::string> warnings;  // e.g. "sofa.msh: 12 tetrahedra were listed in negative order"
};

/// Reads by contents, where they begin as one of these does, else by extension (capitals or not): .msh (Gmsh
/// 1, 2.2, 4.0, 4.1; ASCII and binary where the format has it), .vtk (legacy, ASCII and binary), .vtu (ASCII,
/// base64, raw; zlib, LZ4 and LZMA) and .node/.ele (either name). Of tetrahedra with ten nodes or more the
/// corners are read. Other elements are counted, not read. Labels of the tetrahedra are Gmsh's physical
/// groups, an array of whole numbers in VTK's cell data (region_labels.h has its names), TetGen's last
/// attribute; where a file has two answers, none is taken and `why_no_regions` says so. Throws InputError
/// naming file, line or section, and what was expected; without any tetrahedron, what the file holds instead;
/// for a file of another kind, which (file_kind.h).
RawMesh read_mesh(const std::filesystem::path& file);

/// Writes Gmsh 2.2 ASCII, positions in metres, labels as physical groups.
void write_mesh(const TetraMesh& mesh, const std::filesystem::path& file);

/// What check_mesh is asked for besides.
struct CheckOptions {
  double merge_m = 0;                      // > 0: nodes at most so far apart become the first of them, m
  Numbering numbering = Numbering::kFile;  // of nodes and tetrahedra in messages
  bool ignore_other_cells = false;         // other elements that fill space are left out, with a warning
  bool repair = false;                     // what hangs on nodes or edges only is dropped, with a warning
};

/// Scales to metres, drops unused nodes and reorders negatively listed tetrahedra (both with a
/// warning that counts them); throws InputError naming the elements otherwise: zero volume (height
/// below 1e-6 of the longest edge), repeated or overlapping elements, non-manifold or open boundary,
/// disconnected parts, nodes at the same place (an inner crack, or parts glued by copying), non-finite
/// positions, node numbers out of range; and, unless they are to be ignored, other elements that fill space,
/// by kind and count: without them the organ would be another one. Merging warns, and throws where it would
/// collapse a tetrahedron. Repairing (hanging_tetrahedra.h) says what is dropped and its volume, and throws
/// where that is more than a twentieth of all: this is a part of the organ, not a few elements.
CheckedMesh check_mesh(const RawMesh& raw, double metres_per_unit, const CheckOptions& options = {});

/// Signed volume, m^3: positive when d lies on the side of (a,b,c) its right-handed normal points to.
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

}  // namespace omentum::geometry
