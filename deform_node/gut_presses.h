// What the tools' hands want of an intestine, on its skin and on its masses.
#pragma once

#include "deform_node/contact_book.h"
#include "geometry/gut_skin.h"
#include "physics/dynamics/imposed_press.h"

#include <optional>
#include <vector>

namespace omentum::deform {

/// A press on nodes of the skin is one on the masses that carry these, by their weights; the skin itself
/// gives way by a wall of its own, alike in all directions. Takes its memory when it is made.
class GutPresses {
 public:
  /// `skin` outlives it. `rest`: [nodes of the skin] at the start, in W, m. `wall_m_n`: what a node yields to
  /// a force, m/N.
  GutPresses(const geometry::GutSkin& skin, std::vector<Vec3> rest, double wall_m_n);

  /// What the tools' hands want from now on, in place of the last ones; as strong as they say. `places`: of
  /// the skin now, over the masses at `x`.
  void press(std::span<const ToolLoad> presses, std::span<const Vec3> places,
             std::span<const Vec3> x) noexcept;
  void forget() noexcept;

  /// A tool that grasps has three patterns, along its forces and to two sides of them; others have the first.
  static constexpr std::size_t kMostPatterns = 3 * kMaxTools;
  /// Of masses: displacements are their places.
  std::span<const physics::Press> presses() const noexcept { return presses_; }
  /// How strong each of presses() really is, as a share of what its hand said.
  void act(std::span<const double> strengths) noexcept;
  /// Goes from the strengths that act towards `strengths`, which were found from where these lead, by
  /// Aitken's dynamic relaxation (Kuettler and Wall 2008, eq. 43): the gut yields up to some times more than
  /// the constant matrix of a step says. `first`: in this tick. False: there was nothing left to go.
  bool approach(std::span<const double> strengths, bool first) noexcept;
  /// Along their forces alone, the same for all of them.
  void act(double strength) noexcept;
  /// Whether all act as their hands said, up to such a share.
  bool are_as_said(double share) const noexcept;

  /// By all tools as they act, [masses], N.
  std::span<const Vec3> forces() const noexcept { return forces_; }
  /// One tool's at a node of the skin, N.
  Vec3 of_tool(std::uint32_t tool, NodeId n) const noexcept;
  /// The middle of the nodes of the skin that a tool presses; nothing where it presses none.
  std::optional<Vec3> middle(std::uint32_t tool, std::span<const Vec3> places) const noexcept;
  /// Whether a tool's jaws hold a node of the skin.
  bool grasps(std::uint32_t tool, NodeId n) const noexcept;
  /// Moves the nodes of the skin that tools press into its wall.
  void dent(std::span<Vec3> places) const noexcept;
  bool any_grasps() const noexcept;

 private:
  static constexpr std::size_t kMostMasses = kMaxNodesPerTool * geometry::GutSkin::kMostWeights;
  struct HeldPress {
    std::uint32_t tool = 0;
    double strength = 1, own_yield_j = 0;
    std::size_t count = 0, mass_count = 0;
    bool grasps = false;
    std::array<Vec3, 2> sides{Vec3::Zero(), Vec3::Zero()};  // unit, across all its forces together
    Vec3 aside = Vec3::Zero();                              // to each force, as a share of its size
    std::array<NodeId, kMaxNodesPerTool> nodes;             // of the skin
    std::array<Vec3, kMaxNodesPerTool> forces;
    std::array<NodeId, kMostMasses> masses;  // one may be there several times
    std::array<Vec3, kMostMasses> places, mass_forces;
    std::array<double, kMostMasses> mass_sizes;  // of mass_forces
    std::array<std::array<Vec3, kMostMasses>, 2> side_forces;

    void find_sides() noexcept;
    /// On a node as it acts, N.
    Vec3 force(std::size_t i) const noexcept { return strength * forces[i] + forces[i].norm() * aside; }
  };

  void add(NodeId node, const Vec3& middle, const Vec3& force, HeldPress& held) noexcept;
  void pose(double gain, HeldPress& held) noexcept;
  void add_up() noexcept;

  const geometry::GutSkin& skin_;
  std::vector<Vec3> rest_;  // [nodes of the skin]
  double wall_m_n_;
  std::vector<HeldPress> held_;  // capacity kMaxTools
  std::vector<physics::Press> presses_;
  std::vector<Vec3> forces_;  // [masses]
  double relaxation_ = 1;
  std::vector<double> lacking_, next_;  // [presses] of approach()
};

}  // namespace omentum::deform
