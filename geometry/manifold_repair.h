// Where what is left of a mesh is not manifold, and what is to go so that it becomes so.
#pragma once

#include "geometry/remaining_tetrahedra.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

/// Looks around the nodes that it is told of for what touches in a node or an edge only (Cotin 1998, 5.5):
///   - tetrahedra around a node that faces do not connect: all fans but the largest are to go;
///   - tetrahedra around an edge that faces do not connect: likewise;
///   - boundary faces around a node that form several fans, although faces connect its tetrahedra (hollows
///   that
///     touch there): the fewest tetrahedra that part the first of the hollows from another are to go.
/// Largest: of most tetrahedra, among equals the one with the lowest number; but what is kept is not to go.
/// Whoever removes what it names
/// and tells it of each, until it names nothing, comes to an end, because each answer takes at least one
/// tetrahedron away; then every node that was near a removal has one fan of tetrahedra and one, or none, of
/// boundary faces, and so every boundary edge two faces. Takes its memory when it is made. `left` outlives
/// it.
class ManifoldRepair {
 public:
  /// `kept`: [T], other than 0 for what never is to go, which is manifold by itself; or empty.
  explicit ManifoldRepair(const RemainingTetrahedra& left, std::span<const std::uint8_t> kept = {});

  /// A tetrahedron was removed: its nodes are looked at.
  void note_removed(TetId t) noexcept;
  void note(NodeId n) noexcept;

  /// What is to go at the first node that is not manifold, in the order that they were noted; empty: none is
  /// left. Valid until the next call.
  std::span<const TetId> next() noexcept;

 private:
  // An edge n-a-b of a boundary face at the node n that is looked at.
  struct Side {
    NodeId a, b;
    std::int32_t owner;  // in star_
    std::int32_t fan;
  };

  bool is_manifold_around(NodeId n) noexcept;
  void find_victims_at(NodeId n) noexcept;
  void collect_star(NodeId n) noexcept;
  void collect_sides(NodeId n) noexcept;
  void add_sides_of(std::int32_t owner, NodeId n) noexcept;
  void add_side(NodeId a, NodeId b, std::int32_t owner) noexcept;
  void forget_sides() noexcept;
  void condemn_smaller_fans(NodeId n, NodeId edge_end) noexcept;
  std::int32_t mark_fan(std::int32_t first, std::int32_t fan, NodeId n, NodeId edge_end) noexcept;
  NodeId crowded_edge() const noexcept;
  std::int32_t number_fans_of_sides() noexcept;
  void condemn_bridge(NodeId n) noexcept;
  std::int32_t bridge_end(NodeId n) noexcept;

  bool is_kept(TetId t) const noexcept { return !kept_.empty() && kept_[static_cast<std::size_t>(t)] != 0; }

  const RemainingTetrahedra& left_;
  std::vector<std::uint8_t> kept_;  // [T], or empty
  std::vector<NodeId> noted_;       // a ring, [N]: each node at most once
  std::size_t first_ = 0, noted_count_ = 0;
  std::vector<bool> is_noted_;                         // [N]
  std::vector<TetId> star_;                            // around the node, ascending
  std::vector<std::int32_t> place_;                    // [T], in star_, of those that are there
  std::vector<std::uint8_t> is_seen_;                  // [T], 0 between looks
  std::vector<std::int32_t> fan_;                      // [star]
  std::vector<std::int32_t> fan_size_;                 // [fans]
  std::vector<std::int32_t> pending_;                  // [star], a search's
  std::vector<std::int32_t> reached_from_;             // [star], by it
  std::vector<Side> sides_;                            // at the node
  std::vector<std::int32_t> side_count_;               // [N], of sides_
  std::vector<std::array<std::int32_t, 2>> sides_of_;  // [N], the first two of them
  std::vector<TetId> victims_;                         // [star]
};

}  // namespace omentum::geometry
