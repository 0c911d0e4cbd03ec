#include "geometry/tetra_links.h"

#include "geometry/mesh_topology.h"

#include <algorithm>
#include <numeric>

namespace omentum::geometry {
namespace {

std::vector<std::array<std::int32_t, 4>> as_numbers(std::span<const Tetrahedron> tetrahedra) {
  std::vector<std::array<std::int32_t, 4>> numbers;
  numbers.reserve(tetrahedra.size());
  for (const Tetrahedron& v : tetrahedra) numbers.push_back({v[0], v[1], v[2], v[3]});
  return numbers;
}

// The corner of a tetrahedron that one of its faces lacks.
std::size_t corner_opposite(const Tetrahedron& v, const FaceSide& side) {
  const auto lacked = std::ranges::find_if(
      v, [&](NodeId n) { return std::ranges::find(side.nodes, std::int32_t{n}) == side.nodes.end(); });
  return static_cast<std::size_t>(lacked - v.begin());
}

}  // namespace

TetraLinks::TetraLinks(std::span<const Tetrahedron> tetrahedra, std::size_t node_count)
    : nodes_(tetrahedra.begin(), tetrahedra.end()), across_(tetrahedra.size()) {
  link_faces();
  link_nodes(node_count);
}

void TetraLinks::link_faces() {
  const std::vector<FaceSide> sides = collect_face_sides(as_numbers(nodes_));
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].nodes == sides[first].nodes) ++last;
    ++face_count_;
    if (last - first != 2) continue;
    const FaceSide &a = sides[first], &b = sides[first + 1];
    across_[a.tetrahedron][corner_opposite(nodes_[a.tetrahedron], a)] = TetId(b.tetrahedron);
    across_[b.tetrahedron][corner_opposite(nodes_[b.tetrahedron], b)] = TetId(a.tetrahedron);
  }
}

void TetraLinks::link_nodes(std::size_t node_count) {
  start_.assign(node_count + 1, 0);
  for (const Tetrahedron& v : nodes_) {
    for (const NodeId n : v) ++start_[static_cast<std::size_t>(n) + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  around_.resize(4 * nodes_.size());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t t = 0; t < nodes_.size(); ++t) {
    for (const NodeId n : nodes_[t]) around_[next[static_cast<std::size_t>(n)]++] = TetId(t);
  }
}

int TetraLinks::corner_facing(TetId of, TetId to) const noexcept {
  const std::array<TetId, 4>& behind = across(of);
  return static_cast<int>(std::ranges::find(behind, to) - behind.begin());
}

std::size_t TetraLinks::largest_star() const noexcept {
  std::size_t largest = 0;
  for (std::size_t n = 0; n + 1 < start_.size(); ++n) largest = std::max(largest, start_[n + 1] - start_[n]);
  return largest;
}

}  // namespace omentum::geometry
