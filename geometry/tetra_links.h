// Which tetrahedra of a mesh meet at its faces and nodes.
#pragma once

#include "geometry/types.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// The neighbourhoods of T tetrahedra over N nodes, constant. Copies them. O(T log T) to make, memory O(T).
class TetraLinks {
 public:
  /// Positively oriented tetrahedra, nodes below `node_count`. A face that is shared by more than two counts
  /// as one without neighbours.
  TetraLinks(std::span<const Tetrahedron> tetrahedra, std::size_t node_count);

  std::int32_t tetrahedron_count() const noexcept { return static_cast<std::int32_t>(nodes_.size()); }
  std::int32_t node_count() const noexcept { return static_cast<std::int32_t>(start_.size()) - 1; }

  const Tetrahedron& nodes(TetId t) const noexcept { return nodes_[index(t)]; }

  /// The neighbours behind the faces opposite to each corner; invalid: none.
  const std::array<TetId, 4>& across(TetId t) const noexcept { return across_[index(t)]; }

  /// The corner of `of` that faces its neighbour `to`.
  int corner_facing(TetId of, TetId to) const noexcept;

  /// Tetrahedra around a node, ascending.
  std::span<const TetId> around(NodeId n) const noexcept {
    const std::size_t i = static_cast<std::size_t>(n);
    return std::span(around_).subspan(start_[i], start_[i + 1] - start_[i]);
  }

  /// Distinct faces, of one tetrahedron or two.
  std::size_t face_count() const noexcept { return face_count_; }

  /// The most tetrahedra around one node.
  std::size_t largest_star() const noexcept;

 private:
  static std::size_t index(TetId t) { return static_cast<std::size_t>(t); }
  void link_faces();
  void link_nodes(std::size_t node_count);

  std::vector<Tetrahedron> nodes_;            // [T]
  std::vector<std::array<TetId, 4>> across_;  // [T]
  std::vector<std::size_t> start_;            // [N+1] into around_
  std::vector<TetId> around_;                 // [4 T]
  std::size_t face_count_ = 0;
};

}  // namespace omentum::geometry
