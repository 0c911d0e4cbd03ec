// What pulls and pushes the nodes of an organ with masses: its weight and the tools.
#pragma once

#include "deform_node/contact_book.h"
#include "geometry/mesh_editor.h"
#include "physics/dynamics/carried_mass.h"
#include "physics/dynamics/imposed_press.h"

#include <vector>

namespace omentum::deform {

/// External forces on all nodes. A node carries the weight of the tissue that is left around it: what burnt
/// away is gone (so is its mass, by the same books, but for explicit steps: BodyStepper::mass()), and a node
/// without any carries nothing, whoever presses it. Takes its memory when it is made.
class BodyLoads {
 public:
  BodyLoads(const geometry::TetraMesh& mesh, const physics::MaterialMap& material, const Vec3& gravity_m_s2);

  /// What the tools' hands want from now on, in place of the last ones; as strong as they say.
  void press(std::span<const ToolLoad> presses, const geometry::MeshEditor& editor) noexcept;
  std::span<const physics::Press> presses() const noexcept { return presses_; }
  /// How strong each of presses() really is, as a share of what its hand said.
  void act(std::span<const double> strengths) noexcept;
  /// What other organs push, [3N], N, on nodes that something is left around; until it is put down.
  void carry(std::span<const double> forces, const geometry::MeshEditor& editor) noexcept;
  void put_down() noexcept;
  /// What is left in `editor` after these went, or after all came back.
  void lighten(std::span<const geometry::TetId> gone, const geometry::MeshEditor& editor) noexcept;
  /// These are pulled by another gravity from now on, until restore().
  void let_go(std::span<const geometry::TetId> tetrahedra, const Vec3& gravity_m_s2) noexcept;
  void restore() noexcept;

  /// Weights and what is carried / with the tools' forces as they act, [3N], N.
  std::span<const double> weights() const noexcept { return weights_; }
  std::span<const double> external() const noexcept { return external_; }
  /// One tool's share at a node, N.
  Vec3 of_tool(std::uint32_t tool, NodeId n) const noexcept;
  /// The nodes that a tool's jaws hold.
  std::span<const NodeId> held_by(std::uint32_t tool) const noexcept;

 private:
  /// One tool's, without nodes that nothing is left around.
  struct HeldPress {
    std::uint32_t tool = 0;
    bool grasps = false;
    double strength = 1, gain = 1;
    std::size_t count = 0;
    std::array<NodeId, kMaxNodesPerTool> nodes;
    std::array<Vec3, kMaxNodesPerTool> displacements, forces;

    physics::Press press() const noexcept;
  };

  void keep_attached(HeldPress& held, const geometry::MeshEditor& editor) noexcept;
  void weigh(NodeId n) noexcept;
  void forget_presses() noexcept;

  const geometry::TetraMesh& mesh_;
  Vec3 organ_gravity_;
  std::vector<Vec3> gravity_;     // [N]
  physics::CarriedMass tissue_;   // of what is left, however the body is stepped
  std::vector<bool> is_bare_;     // [N] nothing is left around it
  std::vector<double> weights_;   // [3N]
  std::vector<double> external_;  // [3N]
  std::vector<Vec3> pressed_;     // [N], by the tools
  std::vector<HeldPress> held_;   // capacity kMaxTools
  std::vector<physics::Press> presses_;
};

}  // namespace omentum::deform
