// What a cut leaves of an organ's surface and lays bare, in the numbers of its states.
#pragma once

#include "geometry/mesh_editor.h"
#include "geometry/surface.h"
#include "render_node/known_topologies.h"

namespace omentum::render {

/// The surface of an organ that was cut. Nodes are numbered as in its states (idl/organ.idl): first the S of
/// the whole surface, then those that were bared.
struct CutShape {
  std::vector<geometry::NodeId> node;  // [S'], of the mesh
  std::vector<geometry::Vec3> rest;    // [S'], m
  // [F + C], 1: that triangle of the whole surface is no more, or that of `covered` no longer covered
  std::vector<std::uint8_t> gone;
  std::vector<geometry::Triangle> bared;  // outward
  std::vector<float> burnt;               // [S'], 1: a tetrahedron at this node was burnt away; else 0
};

/// Brings mesh and removed set to a surface. Its books take memory by the size of the mesh: make one only for
/// an organ that was cut. One thread.
class OrganCut {
 public:
  /// `mesh` and `whole`, its uncut surface, outlive it. `covered`: what is no surface as yet.
  OrganCut(const geometry::TetraMesh& mesh, const geometry::Surface& whole,
           std::span<const geometry::CoveredFace> covered = {});

  /// From here on exactly these are removed. Precondition: they are of the mesh (known_topologies.h).
  void set(const RemovedSet& removed);
  std::size_t node_count() const { return editor_.surface_nodes().size(); }
  std::int32_t removed_count() const { return editor_.removed_count(); }
  CutShape shape() const;

 private:
  bool is_covered(const geometry::CoveredFace& face) const;
  std::vector<float> burnt_nodes() const;

  const geometry::TetraMesh& mesh_;
  const geometry::Surface& whole_;
  std::vector<geometry::CoveredFace> covered_;
  geometry::MeshEditor editor_;
  std::vector<std::uint8_t> burnt_;  // as in RemovedSet
};

}  // namespace omentum::render
