// What pulls and pushes the nodes of an organ with masses: its weight and the tools.
#pragma once

#include "deform_node/organ_models.h"
#include "geometry/mesh_editor.h"
#include "physics/material_map.h"

#include <vector>

namespace omentum::deform {

/// External forces on all nodes. A node carries the weight of the tissue that is left around it: what burnt
/// away is gone, though its mass stays for the integrator's sake (physics/dynamics/body_state.h), and a node
/// without any carries nothing, whoever presses it. Takes its memory when it is made.
class BodyLoads {
 public:
  BodyLoads(const geometry::TetraMesh& mesh, const physics::MaterialMap& material, const Vec3& gravity_m_s2);

  /// The tools' forces from now on, in place of the last ones.
  void press(std::span<const ToolLoad> presses, const geometry::MeshEditor& editor) noexcept;
  /// What is left in `editor` after these went, or after all came back.
  void lighten(std::span<const geometry::TetId> gone, const geometry::MeshEditor& editor) noexcept;
  void restore() noexcept;

  /// [3N], N.
  std::span<const double> external() const noexcept { return external_; }
  /// One tool's share at a node, N.
  Vec3 of_tool(std::uint32_t tool, NodeId n) const noexcept;

 private:
  struct Press {
    std::uint32_t tool;
    NodeId node;
    Vec3 force;
  };

  void weigh(NodeId n) noexcept;

  const geometry::TetraMesh& mesh_;
  Vec3 gravity_;
  std::vector<double> quarter_kg_;  // [T], of each tetrahedron's mass
  std::vector<double> carried_kg_;  // [N]
  std::vector<double> uncut_kg_;    // [N]
  std::vector<double> external_;    // [3N]
  std::vector<Vec3> pressed_;       // [N], by the tools
  std::vector<Press> presses_;      // capacity kMaxLoadedNodes
};

}  // namespace omentum::deform
