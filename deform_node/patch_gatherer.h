// The piece of a mesh's surface that is cut around a place, as a LocalPatch numbers it.
#pragma once

#include "deform_node/patch_choice.h"
#include "geometry/mesh_editor.h"

#include <span>

namespace omentum::deform {

/// The faces that a mesh has now, cut or not (PatchChoice).
class PatchGatherer {
 public:
  /// `mesh` outlives it. `most_nodes`: as PatchChoice takes them.
  PatchGatherer(const geometry::TetraMesh& mesh, std::size_t most_nodes);

  /// Writes nodes, triangles and both counts into `patch`; false where no face is held or within the place's
  /// radius.
  /// `u`: [3N], displacements from rest, m.
  bool gather(const PatchPlace& place, const geometry::MeshEditor& editor, std::span<const double> u,
              LocalPatch& patch) noexcept;

  /// The mesh nodes of the last patch, in its order.
  std::span<const geometry::NodeId> nodes() const noexcept { return choice_.nodes(); }

 private:
  const geometry::TetraMesh& mesh_;
  PatchChoice choice_;
};

}  // namespace omentum::deform
