#include "organ/split_organ.h"

#include "geometry/mesh_editor.h"
#include "organ/tied_split.h"

#include <algorithm>
#include <map>

namespace omentum::organ {

namespace {

using geometry::InputError;
using geometry::NodeId;
using geometry::SurfaceId;
using geometry::TetId;
using geometry::TetraMesh;

std::vector<TetId> those_of(const std::vector<std::uint8_t>& flags) {
  std::vector<TetId> found;
  for (std::size_t t = 0; t < flags.size(); ++t)
    if (flags[t] != 0) found.emplace_back(t);
  return found;
}

std::string node_text(const TetraMesh& mesh, NodeId n) {
  const auto names = mesh.names_of_nodes(geometry::Numbering::kFile);
  return "node " + std::to_string(names.of(static_cast<std::size_t>(mesh.file_node[n])));
}

std::string tetrahedron_text(const TetraMesh& mesh, TetId t) {
  const geometry::FileNumbers names(mesh.tetrahedron_numbers, mesh.tetrahedra.size(),
                                    geometry::Numbering::kFile);
  return std::to_string(names.of(static_cast<std::size_t>(t)));
}

bool is_held(const TetraMesh& mesh, const physics::FixedComponents& fixed, std::span<const TetId> piece) {
  std::vector<std::uint8_t> flags(mesh.tetrahedra.size(), 1);
  for (const TetId t : piece) flags[t] = 0;
  const physics::MeshPart part = physics::split_mesh(mesh, flags).precomputed;
  try {
    physics::require_held(part.mesh, physics::supports_of(part, fixed));
  } catch (const physics::FloatingError&) {
    return false;
  }
  return true;
}

// Pieces that only the dynamic part joins.
void require_pieces_held(const TetraMesh& mesh, const physics::FixedComponents& fixed,
                         const std::vector<std::uint8_t>& dynamic, const std::string& where) {
  geometry::MeshEditor left(mesh);
  left.remove(those_of(dynamic));
  std::map<std::int32_t, std::vector<TetId>> pieces;
  for (std::size_t t = 0; t < dynamic.size(); ++t)
    if (!left.is_removed(TetId(t))) pieces[left.piece_of(TetId(t))].emplace_back(t);
  for (const auto& [label, piece] : pieces) {
    if (is_held(mesh, fixed, piece)) continue;
    throw InputError(where + "the dynamic part leaves a piece of " + std::to_string(piece.size()) +
                     " tetrahedra beside it, " + tetrahedron_text(mesh, piece.front()) +
                     " among them, that no support holds; expected a precomputed part that stands without "
                     "the dynamic one");
  }
}

void require_free(const OrganSplit& split, const TetraMesh& mesh, const std::string& where) {
  for (const SurfaceId s : split.connection) {
    const NodeId own = split.surface.node[s];
    if (split.fixed[own] == 0) continue;
    throw InputError(where + node_text(mesh, split.parts.precomputed.node[own]) +
                     " connects the dynamic part to the precomputed one and is held by a support; expected "
                     "connection nodes that are free");
  }
}

}  // namespace

std::vector<std::uint8_t> OrganSplit::precomputed() const {
  std::vector<std::uint8_t> flags;
  for (const std::uint8_t moves : dynamic) flags.push_back(moves == 0 ? 1 : 0);
  return flags;
}

std::size_t take_what_would_hang(const TetraMesh& mesh, std::vector<std::uint8_t>& dynamic) {
  geometry::MeshEditor left(mesh);
  const geometry::Removal removal = left.remove(those_of(dynamic));
  for (const TetId t : removal.repaired) dynamic[t] = 1;
  return removal.repaired.size();
}

OrganSplit split_organ(const TetraMesh& mesh, const physics::FixedComponents& fixed,
                       std::vector<std::uint8_t> dynamic, const std::string& where, BorderFaces border) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(dynamic, [](auto d) { return d != 0; }));
  if (count == 0 || count == dynamic.size()) {
    throw InputError(where + "the dynamic part holds " +
                     (count == 0 ? "no tetrahedron" : "every tetrahedron") + "; expected some of " +
                     std::to_string(dynamic.size()));
  }
  OrganSplit split;
  split.dynamic = std::move(dynamic);
  split.parts = physics::split_mesh(mesh, split.dynamic);
  require_pieces_held(mesh, fixed, split.dynamic, where);
  split.fixed = physics::supports_of(split.parts.precomputed, fixed);
  split.surface = geometry::extract_surface(split.parts.precomputed.mesh, physics::pinned_nodes(split.fixed));
  for (const NodeId n : split.parts.connection)
    split.connection.push_back(split.surface.of_node[split.parts.precomputed.own_node[n]]);
  if (!border.empty()) tie_split(split, std::move(border), where);
  require_free(split, mesh, where);
  for (std::int32_t s = 0; s < split.surface.mobile_count; ++s)
    split.tensor_node.push_back(
        split.parts.precomputed.node[split.surface.node[static_cast<std::size_t>(s)]]);
  return split;
}

}  // namespace omentum::organ
