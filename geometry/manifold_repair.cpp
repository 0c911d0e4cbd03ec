#include "geometry/manifold_repair.h"

#include "geometry/at_id.h"

#include <algorithm>
#include <limits>

namespace omentum::geometry {
namespace {

// Calls visit(neighbour) for those left behind the faces that hold the node n and, where it is valid,
// edge_end.
template <class Visit>
void for_each_neighbour_around(const RemainingTetrahedra& left, TetId t, NodeId n, NodeId edge_end,
                               Visit&& visit) {
  const Tetrahedron& v = left.links().nodes(t);
  const std::array<TetId, 4>& across = left.links().across(t);
  for (std::size_t c = 0; c < 4; ++c) {
    if (v[c] != n && v[c] != edge_end && left.has_neighbour(across[c])) visit(across[c]);
  }
}

}  // namespace

ManifoldRepair::ManifoldRepair(const RemainingTetrahedra& left, std::span<const std::uint8_t> kept)
    : left_(left),
      kept_(kept.begin(), kept.end()),
      noted_(static_cast<std::size_t>(left.links().node_count())),
      is_noted_(noted_.size(), false),
      place_(static_cast<std::size_t>(left.links().tetrahedron_count()), kNone),
      is_seen_(place_.size(), 0),
      side_count_(noted_.size(), 0),
      sides_of_(noted_.size()) {
  const std::size_t star = left.links().largest_star();
  star_.reserve(star);
  fan_.reserve(star);
  fan_size_.reserve(star);
  pending_.reserve(star);
  reached_from_.reserve(star);
  sides_.reserve(3 * star);
  victims_.reserve(star);
}

void ManifoldRepair::note_removed(TetId t) noexcept {
  for (const NodeId n : left_.links().nodes(t)) note(n);
}

void ManifoldRepair::note(NodeId n) noexcept {
  if (is_noted_[static_cast<std::size_t>(n)]) return;
  is_noted_[static_cast<std::size_t>(n)] = true;
  noted_[(first_ + noted_count_++) % noted_.size()] = n;
}

std::span<const TetId> ManifoldRepair::next() noexcept {
  victims_.clear();
  for (; noted_count_ > 0; --noted_count_, first_ = (first_ + 1) % noted_.size()) {
    const NodeId n = noted_[first_];
    find_victims_at(n);
    if (!victims_.empty()) break;  // the node stays the first: it is looked at again
    is_noted_[static_cast<std::size_t>(n)] = false;
  }
  return victims_;
}

// The usual case, in one walk through the faces around the node.
bool ManifoldRepair::is_manifold_around(NodeId n) noexcept {
  if (left_.uses(n) == 0) return true;
  const auto see = [this](TetId t) {
    if (at(is_seen_, t) != 0) return;
    at(is_seen_, t) = 1;
    star_.push_back(t);
  };
  star_.clear();
  sides_.clear();
  see(*std::ranges::find_if(left_.links().around(n), [this](TetId t) { return left_.has(t); }));
  for (std::size_t i = 0; i < star_.size(); ++i) {
    add_sides_of(static_cast<std::int32_t>(i), n);
    for_each_neighbour_around(left_, star_[i], n, NodeId{}, see);
  }
  for (const TetId t : star_) at(is_seen_, t) = 0;
  const bool one_fan = static_cast<std::int32_t>(star_.size()) == left_.uses(n);
  const bool manifold = one_fan && !crowded_edge().valid() && number_fans_of_sides() < 2;
  forget_sides();
  return manifold;
}

void ManifoldRepair::find_victims_at(NodeId n) noexcept {
  if (is_manifold_around(n)) return;
  collect_star(n);
  condemn_smaller_fans(n, NodeId{});
  if (!victims_.empty()) return;
  collect_sides(n);
  if (const NodeId edge_end = crowded_edge(); edge_end.valid()) {
    condemn_smaller_fans(n, edge_end);
  } else {
    number_fans_of_sides();
    condemn_bridge(n);
  }
  forget_sides();
}

void ManifoldRepair::collect_star(NodeId n) noexcept {
  star_.clear();
  for (const TetId t : left_.links().around(n)) {
    if (!left_.has(t)) continue;
    at(place_, t) = static_cast<std::int32_t>(star_.size());
    star_.push_back(t);
  }
}

// Marks what faces around n, and around the edge n-edge_end where there is one, connect to `first`; how many.
std::int32_t ManifoldRepair::mark_fan(std::int32_t first, std::int32_t fan, NodeId n,
                                      NodeId edge_end) noexcept {
  pending_.assign(1, first);
  at(fan_, first) = fan;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    for_each_neighbour_around(left_, at(star_, pending_[i]), n, edge_end, [&](TetId neighbour) {
      const std::int32_t place = at(place_, neighbour);
      if (at(fan_, place) != kNone) return;
      at(fan_, place) = fan;
      pending_.push_back(place);
    });
  }
  return static_cast<std::int32_t>(pending_.size());
}

void ManifoldRepair::condemn_smaller_fans(NodeId n, NodeId edge_end) noexcept {
  fan_.assign(star_.size(), kNone);
  fan_size_.clear();
  for (std::size_t i = 0; i < star_.size(); ++i) {
    const Tetrahedron& v = left_.links().nodes(star_[i]);
    const bool concerned = !edge_end.valid() || std::ranges::find(v, edge_end) != v.end();
    if (!concerned || fan_[i] != kNone) continue;
    const std::int32_t fan = static_cast<std::int32_t>(fan_size_.size());
    fan_size_.push_back(mark_fan(static_cast<std::int32_t>(i), fan, n, edge_end));
  }
  if (fan_size_.size() < 2) return;
  for (std::size_t i = 0; i < star_.size(); ++i)
    if (fan_[i] != kNone && is_kept(star_[i]))
      at(fan_size_, fan_[i]) = std::numeric_limits<std::int32_t>::max();
  const auto largest = std::ranges::max_element(fan_size_) - fan_size_.begin();
  for (std::size_t i = 0; i < star_.size(); ++i) {
    if (fan_[i] != kNone && fan_[i] != largest) victims_.push_back(star_[i]);
  }
}

void ManifoldRepair::collect_sides(NodeId n) noexcept {
  sides_.clear();
  for (std::size_t i = 0; i < star_.size(); ++i) add_sides_of(static_cast<std::int32_t>(i), n);
}

void ManifoldRepair::add_sides_of(std::int32_t owner, NodeId n) noexcept {
  const TetId t = at(star_, owner);
  const Tetrahedron& v = left_.links().nodes(t);
  const std::array<TetId, 4>& across = left_.links().across(t);
  for (std::size_t c = 0; c < 4; ++c) {
    if (v[c] == n || left_.has_neighbour(across[c])) continue;
    std::array<NodeId, 2> ends;
    std::size_t found = 0;
    for (const NodeId other : v) {
      if (other != n && other != v[c]) ends[found++] = other;
    }
    add_side(ends[0], ends[1], owner);
  }
}

void ManifoldRepair::add_side(NodeId a, NodeId b, std::int32_t owner) noexcept {
  for (const NodeId end : {a, b}) {
    const std::int32_t others = at(side_count_, end)++;
    if (others < 2)
      at(sides_of_, end)[static_cast<std::size_t>(others)] = static_cast<std::int32_t>(sides_.size());
  }
  sides_.push_back({a, b, owner, kNone});
}

void ManifoldRepair::forget_sides() noexcept {
  for (const Side& side : sides_) at(side_count_, side.a) = at(side_count_, side.b) = 0;
}

// The lowest node at the other end of an edge with more than two boundary faces; invalid: none.
NodeId ManifoldRepair::crowded_edge() const noexcept {
  NodeId lowest;
  for (const Side& side : sides_) {
    for (const NodeId end : {side.a, side.b}) {
      if (side_count_[static_cast<std::size_t>(end)] > 2 && (!lowest.valid() || end < lowest)) lowest = end;
    }
  }
  return lowest;
}

// Each end of a side belongs to exactly two: they form closed walks, the fans of boundary faces.
std::int32_t ManifoldRepair::number_fans_of_sides() noexcept {
  std::int32_t fans = 0;
  for (std::size_t first = 0; first < sides_.size(); ++first) {
    if (sides_[first].fan != kNone) continue;
    std::int32_t s = static_cast<std::int32_t>(first);
    for (NodeId end = sides_[first].b; at(sides_, s).fan == kNone;) {
      at(sides_, s).fan = fans;
      const std::array<std::int32_t, 2>& both = at(sides_of_, end);
      s = both[0] == s ? both[1] : both[0];
      end = at(sides_, s).a == end ? at(sides_, s).b : at(sides_, s).a;
    }
    ++fans;
  }
  return fans;
}

// Condemns a shortest way through faces around n from the first fan of boundary faces to another one.
void ManifoldRepair::condemn_bridge(NodeId n) noexcept {
  for (std::int32_t i = bridge_end(n); i != kNone; i = at(reached_from_, i)) victims_.push_back(at(star_, i));
}

// Searches in width; where it ends, reached_from_ leads back to the first fan.
std::int32_t ManifoldRepair::bridge_end(NodeId n) noexcept {
  constexpr std::int32_t kUnreached = -2, kFar = 1;
  reached_from_.assign(star_.size(), kUnreached);
  fan_.assign(star_.size(), 0);
  pending_.clear();
  for (const Side& side : sides_) {
    if (is_kept(at(star_, side.owner))) continue;
    if (side.fan != 0) {
      at(fan_, side.owner) = kFar;
    } else if (at(reached_from_, side.owner) == kUnreached) {
      at(reached_from_, side.owner) = kNone;
      pending_.push_back(side.owner);
    }
  }
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    const std::int32_t from = pending_[i];
    if (at(fan_, from) == kFar) return from;
    for_each_neighbour_around(left_, at(star_, from), n, NodeId{}, [&](TetId neighbour) {
      const std::int32_t place = at(place_, neighbour);
      if (at(reached_from_, place) != kUnreached || is_kept(neighbour)) return;
      at(reached_from_, place) = from;
      pending_.push_back(place);
    });
  }
  return kNone;
}

}  // namespace omentum::geometry
