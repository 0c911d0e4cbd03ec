#include "organ_tools/organ_solve/cut_organ.h"

#include "geometry/mesh_editor.h"

#include <algorithm>
#include <map>
#include <string>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::NodeId;
using geometry::TetId;
using Imposed = std::span<const physics::ImposedDisplacement>;

std::map<std::int32_t, std::vector<TetId>> pieces_of(const geometry::MeshEditor& editor, std::size_t count) {
  std::map<std::int32_t, std::vector<TetId>> pieces;
  for (std::size_t t = 0; t < count; ++t) {
    if (!editor.is_removed(TetId(t))) pieces[editor.piece_of(TetId(t))].emplace_back(t);
  }
  return pieces;
}

// Of the nodes of one piece, each once.
void require_piece_held(const organ::Organ& organ, std::span<const TetId> piece,
                        const physics::FixedComponents& held, geometry::Numbering numbering) {
  geometry::TetraMesh part;
  physics::FixedComponents part_held;
  std::vector<bool> taken(held.size());
  for (const TetId t : piece) {
    for (const NodeId n : organ.mesh.tetrahedra[t]) {
      if (taken[n]) continue;
      taken[n] = true;
      part.positions.push_back(organ.mesh.positions[n]);
      part_held.push_back(held[n]);
    }
  }
  try {
    physics::require_held(part, part_held);
  } catch (const physics::FloatingError&) {
    const geometry::FileNumbers names(organ.mesh.tetrahedron_numbers, organ.mesh.tetrahedra.size(),
                                      numbering);
    throw InputError(
        "--remove cuts a piece of " + std::to_string(piece.size()) + " tetrahedra loose, " +
        std::to_string(names.of(static_cast<std::size_t>(piece.front()))) +
        " among them, which never comes to rest; expected supports or imposed nodes that hold it");
  }
}

// All nodes, and the tetrahedra that are left.
geometry::TetraMesh left_of(const organ::Organ& organ, const CutOrgan& cut) {
  std::vector<bool> gone(organ.mesh.tetrahedra.size());
  for (const TetId t : cut.removed) gone[t] = true;
  geometry::TetraMesh left;
  left.positions = organ.mesh.positions;
  for (std::size_t t = 0; t < gone.size(); ++t) {
    if (gone[t]) continue;
    left.tetrahedra.push_back(organ.mesh.tetrahedra[t]);
    if (!organ.mesh.regions.empty()) left.regions.push_back(organ.mesh.regions[t]);
  }
  return left;
}

std::vector<std::uint8_t> kept_of(const organ::Organ& organ, std::span<const TetId> asked) {
  if (!organ.split) return {};
  const auto moves = [&](TetId t) { return organ.split->dynamic[t] != 0; };
  return std::ranges::all_of(asked, moves) ? organ.split->precomputed() : std::vector<std::uint8_t>{};
}

// [N]: nodes that the border of a precomputed part follows which shares none with the dynamic one. They hold
// what is left around them, and where nothing is, the precomputed part still holds them.
std::vector<bool> leaders_of(const organ::Organ& organ) {
  std::vector<bool> leads(organ.mesh.positions.size());
  if (!organ.split || !organ.split->tie) return leads;
  for (const NodeId m : organ.split->tie->map.masters) leads[organ.split->parts.dynamic.node[m]] = true;
  return leads;
}

}  // namespace

CutOrgan cut_organ(const organ::Organ& organ, std::span<const TetId> asked, Imposed imposed,
                   geometry::Numbering numbering) {
  CutOrgan cut;
  cut.fixed = organ.fixed;
  if (asked.empty()) return cut;
  const std::vector<std::uint8_t> kept = kept_of(organ, asked);
  geometry::MeshEditor editor(organ.mesh, {.kept = kept});
  const geometry::Removal removal = editor.remove(asked);
  cut.removed.assign(removal.asked.begin(), removal.asked.end());
  cut.removed.insert(cut.removed.end(), removal.repaired.begin(), removal.repaired.end());
  cut.repaired = removal.repaired.size();

  const std::vector<bool> leads = leaders_of(organ);
  for (std::size_t n = 0; n < cut.fixed.size(); ++n) {
    if (editor.uses(NodeId(n)) == 0 && !leads[n]) cut.fixed[n] = physics::kPinned;
  }
  physics::FixedComponents held = cut.fixed;
  for (std::size_t n = 0; n < held.size(); ++n)
    if (leads[n]) held[n] = physics::kPinned;
  for (const physics::ImposedDisplacement& i : imposed) {
    if (editor.uses(i.node) == 0) {
      const auto position = static_cast<std::size_t>(organ.mesh.file_node[i.node]);
      throw InputError("node " + std::to_string(organ.mesh.names_of_nodes(numbering).of(position)) +
                       ": --remove takes all its tetrahedra; expected imposed nodes of what is left");
    }
    held[i.node] = physics::kPinned;
  }
  for (const auto& [label, piece] : pieces_of(editor, organ.mesh.tetrahedra.size()))
    require_piece_held(organ, piece, held, numbering);
  return cut;
}

physics::Stiffness stiffness_of(const organ::Organ& organ, const CutOrgan& cut) {
  return physics::assemble_stiffness(left_of(organ, cut), organ.material);
}

std::vector<geometry::Vec3> weights_of(const organ::Organ& organ, const CutOrgan& cut,
                                       const geometry::Vec3& gravity) {
  return physics::body_forces(left_of(organ, cut), organ.material, gravity);
}

}  // namespace omentum::organ_tools
