// The piece of a surface that is cut around a place, as a LocalPatch numbers it.
#pragma once

#include "deform_node/local_patch.h"
#include "geometry/mesh_editor.h"

#include <span>
#include <vector>

namespace omentum::deform {

/// Picks the faces that come near a place, the nearest first, as long as their nodes fit, and every other
/// face between those nodes. Takes its memory when it is made; one thread at a time.
class PatchGatherer {
 public:
  /// `mesh` outlives it. `most_nodes`: at least three, at most 256 (LocalPatch::triangles has bytes).
  PatchGatherer(const geometry::TetraMesh& mesh, std::size_t most_nodes);

  /// Writes nodes, triangles and both counts into `patch`; false where no face is within the place's radius.
  /// `u`: [3N], displacements from rest, m.
  bool gather(const PatchPlace& place, const geometry::MeshEditor& editor, std::span<const double> u,
              LocalPatch& patch) noexcept;

  /// The mesh nodes of the last patch, in its order.
  std::span<const geometry::NodeId> nodes() const noexcept { return nodes_; }

 private:
  struct Near {
    double squared_distance;
    std::size_t face;  // of editor.faces()
  };
  using Places = std::array<geometry::Vec3, 3>;

  Places places_of(const geometry::SurfaceFace& face, std::span<const double> u) const noexcept;
  void find_near(const PatchPlace& place, const geometry::MeshEditor& editor,
                 std::span<const double> u) noexcept;
  bool has_room_for(const geometry::SurfaceFace& face) const noexcept;
  void number(const geometry::SurfaceFace& face) noexcept;

  const geometry::TetraMesh& mesh_;
  std::size_t most_nodes_;
  std::vector<Near> near_;               // capacity 4T
  std::vector<std::int16_t> number_of_;  // [N], in the patch; -1: not of it
  std::vector<geometry::NodeId> nodes_;  // capacity most_nodes
};

}  // namespace omentum::deform
