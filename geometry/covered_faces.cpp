#include "geometry/covered_faces.h"

#include "geometry/tetra_faces.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace omentum::geometry {

namespace {

std::size_t at(TetId t) {
  return static_cast<std::size_t>(t);
}

bool is_before(const CoveredFace& a, TetId behind, int corner) {
  return a.behind != behind ? a.behind < behind : a.corner < corner;
}

std::array<NodeId, 3> sorted_nodes(std::array<NodeId, 3> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

}  // namespace

CoveredFaces::CoveredFaces(std::span<const CoveredFace> faces, std::size_t tetrahedron_count)
    : faces_(faces.begin(), faces.end()), missing_(faces.size(), 0) {
  if (faces_.empty()) return;
  std::ranges::sort(
      faces_, [](const CoveredFace& a, const CoveredFace& b) { return is_before(a, b.behind, b.corner); });
  start_.resize(tetrahedron_count + 1);
  for (const CoveredFace& face : faces_)
    for (const TetId t : face.by) ++start_[at(t) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  covered_.resize(static_cast<std::size_t>(start_.back()));
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const TetId t : faces_[f].by)
      covered_[static_cast<std::size_t>(next[at(t)]++)] = static_cast<std::int32_t>(f);
}

std::span<const std::int32_t> CoveredFaces::covered_by(TetId t) const noexcept {
  if (start_.empty()) return {};
  return {covered_.data() + start_[at(t)], covered_.data() + start_[at(t) + 1]};
}

std::int32_t CoveredFaces::place_of(TetId behind, int corner) const noexcept {
  const auto found = std::lower_bound(
      faces_.begin(), faces_.end(), behind,
      [corner](const CoveredFace& face, TetId wanted) { return is_before(face, wanted, corner); });
  const bool is_it = found != faces_.end() && found->behind == behind && found->corner == corner;
  return is_it ? static_cast<std::int32_t>(found - faces_.begin()) : -1;
}

Surface without_covered(const TetraMesh& mesh, const Surface& surface, std::span<const CoveredFace> faces) {
  std::set<std::array<NodeId, 3>> covered;
  for (const CoveredFace& face : faces) {
    const Tetrahedron& v = mesh.tetrahedra[face.behind];
    const auto& [j, k, l] = kFaceOpposite[static_cast<std::size_t>(face.corner)];
    covered.insert(sorted_nodes(
        {v[static_cast<std::size_t>(j)], v[static_cast<std::size_t>(k)], v[static_cast<std::size_t>(l)]}));
  }
  Surface left = surface;
  left.triangles.clear();
  left.tetrahedron.clear();
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const auto node = [&](std::size_t i) { return surface.node[surface.triangles[f][i]]; };
    if (covered.contains(sorted_nodes({node(0), node(1), node(2)}))) continue;
    left.triangles.push_back(surface.triangles[f]);
    left.tetrahedron.push_back(surface.tetrahedron[f]);
  }
  std::vector<std::vector<TriangleId>> fans(surface.node.size());
  for (std::size_t f = 0; f < left.triangles.size(); ++f)
    for (const SurfaceId s : left.triangles[f]) fans[static_cast<std::size_t>(s)].emplace_back(f);
  left.fan_start.assign(1, 0);
  left.fan.clear();
  for (const std::vector<TriangleId>& fan : fans) {
    left.fan.insert(left.fan.end(), fan.begin(), fan.end());
    left.fan_start.push_back(static_cast<std::int32_t>(left.fan.size()));
  }
  return left;
}

}  // namespace omentum::geometry
