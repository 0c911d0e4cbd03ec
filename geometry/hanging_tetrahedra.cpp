#include "geometry/hanging_tetrahedra.h"

#include "geometry/loose_pieces.h"
#include "geometry/manifold_repair.h"

#include <algorithm>
#include <numeric>

namespace omentum::geometry {
namespace {

std::vector<Tetrahedron> as_nodes(RawTetrahedra raw) {
  std::vector<Tetrahedron> nodes;
  nodes.reserve(raw.size());
  for (const auto& [a, b, c, d] : raw) nodes.push_back({NodeId(a), NodeId(b), NodeId(c), NodeId(d)});
  return nodes;
}

// The lowest node that tetrahedra connect each node with.
std::vector<NodeId> lowest_connected(RawTetrahedra tetrahedra, std::size_t node_count) {
  std::vector<NodeId> lowest;
  for (std::size_t n = 0; n < node_count; ++n) lowest.emplace_back(n);
  const auto root = [&](NodeId n) {
    while (lowest[static_cast<std::size_t>(n)] != n) {
      NodeId& parent = lowest[static_cast<std::size_t>(n)];
      n = parent = lowest[static_cast<std::size_t>(parent)];
    }
    return n;
  };
  for (const auto& v : tetrahedra) {
    for (const std::int32_t n : v) {
      const auto [low, high] = std::minmax({root(NodeId(v[0])), root(NodeId(n))});
      lowest[static_cast<std::size_t>(high)] = low;
    }
  }
  for (std::size_t n = 0; n < node_count; ++n) lowest[n] = root(NodeId(n));
  return lowest;
}

// What is left of an unchecked mesh.
class Hanging {
 public:
  Hanging(RawTetrahedra tetrahedra, std::size_t node_count)
      : links_(as_nodes(tetrahedra), node_count),
        left_(links_),
        repair_(left_),
        pieces_(left_, std::vector<double>(tetrahedra.size(), 1)),
        body_(lowest_connected(tetrahedra, node_count)) {}

  Offenders find() {
    drop_smaller_parts();
    for (std::int32_t n = 0; n < links_.node_count(); ++n) repair_.note(NodeId(n));
    for (auto victims = repair_.next(); !victims.empty(); victims = repair_.next()) {
      for (const TetId t : victims) {
        left_.take(t);
        repair_.note_removed(t);
      }
    }
    drop_smaller_parts();
    Offenders gone;
    for (std::int32_t t = 0; t < links_.tetrahedron_count(); ++t) {
      if (!left_.has(TetId(t))) gone.push_back(static_cast<std::size_t>(t));
    }
    return gone;
  }

 private:
  std::size_t body_of(TetId t) const {
    return static_cast<std::size_t>(body_[static_cast<std::size_t>(links_.nodes(t)[0])]);
  }
  std::size_t piece_of(TetId t) const { return static_cast<std::size_t>(pieces_.piece_of(t)); }

  // Of the parts of each body, which share nodes, the largest stays, of equals the first.
  void drop_smaller_parts() {
    pieces_.count_anew();
    std::vector<TetId> left;
    for (std::int32_t t = 0; t < links_.tetrahedron_count(); ++t) {
      if (left_.has(TetId(t))) left.emplace_back(t);
    }
    std::vector<std::size_t> size(left_.removed_bits().size() * 8, 0);
    for (const TetId t : left) ++size[piece_of(t)];
    std::vector<TetId> largest(body_.size());
    for (const TetId t : left) {
      TetId& best = largest[body_of(t)];
      if (!best.valid() || size[piece_of(t)] > size[piece_of(best)]) best = t;
    }
    for (const TetId t : left) {
      if (piece_of(t) != piece_of(largest[body_of(t)])) left_.take(t);
    }
  }

  TetraLinks links_;
  RemainingTetrahedra left_;
  ManifoldRepair repair_;
  LoosePieces pieces_;
  std::vector<NodeId> body_;  // [N]
};

}  // namespace

Offenders hanging_tetrahedra(RawTetrahedra tetrahedra, std::size_t node_count) {
  const std::vector<FaceSide> sides = collect_face_sides(tetrahedra);
  if (!find_face_faults(sides, tetrahedra.size()).crowded.empty()) return {};
  return Hanging(tetrahedra, node_count).find();
}

}  // namespace omentum::geometry
