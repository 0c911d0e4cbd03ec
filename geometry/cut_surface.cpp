#include "geometry/cut_surface.h"

#include "geometry/precondition.h"
#include "geometry/tetra_faces.h"

#include <algorithm>

namespace omentum::geometry {

CutSurface::CutSurface(const TetraLinks& links, std::span<const NodeId> uncut)
    : links_(links),
      uncut_count_(uncut.size()),
      uncut_place_(static_cast<std::size_t>(links.node_count())),
      at_(static_cast<std::size_t>(links.tetrahedron_count()), {-1, -1, -1, -1}),
      face_count_(uncut_place_.size(), 0),
      is_unsettled_(uncut_place_.size(), false) {
  faces_.reserve(links.face_count());
  nodes_.reserve(uncut_place_.size());
  unsettled_.reserve(uncut_place_.size());
  nodes_.assign(uncut.begin(), uncut.end());
  for (std::size_t s = 0; s < uncut.size(); ++s)
    uncut_place_[static_cast<std::size_t>(uncut[s])] = SurfaceId(s);
  for (std::int32_t t = 0; t < links.tetrahedron_count(); ++t) {
    for (int corner = 0; corner < 4; ++corner) {
      if (!links.across(TetId(t))[static_cast<std::size_t>(corner)].valid()) open(TetId(t), corner);
    }
  }
  require(unsettled_.empty(), "the nodes of the whole uncut surface");
}

void CutSurface::count(const SurfaceFace& face, std::int32_t change) noexcept {
  for (const NodeId n : face.nodes) {
    const std::size_t i = static_cast<std::size_t>(n);
    face_count_[i] += change;
    if (uncut_place_[i].valid() || is_unsettled_[i]) continue;
    is_unsettled_[i] = true;
    unsettled_.push_back(n);
  }
}

void CutSurface::open(TetId t, int corner, bool bared) noexcept {
  const std::size_t i = static_cast<std::size_t>(t), c = static_cast<std::size_t>(corner);
  const auto& [j, k, l] = kFaceOpposite[c];
  const Tetrahedron& v = links_.nodes(t);
  at_[i][c] = static_cast<std::int32_t>(faces_.size());
  faces_.push_back({{v[j], v[k], v[l]}, t, bared || links_.across(t)[c].valid()});
  count(faces_.back(), 1);
}

void CutSurface::close(TetId t, int corner) noexcept {
  std::int32_t& place = at_[static_cast<std::size_t>(t)][static_cast<std::size_t>(corner)];
  SurfaceFace& face = faces_[static_cast<std::size_t>(place)];
  count(face, -1);
  // the last face moves into the gap
  const std::size_t last = faces_.size() - 1;
  face = faces_.back();
  faces_.pop_back();
  std::ranges::replace(at_[static_cast<std::size_t>(face.behind)], static_cast<std::int32_t>(last), place);
  place = -1;
}

std::vector<NodeId>::iterator CutSurface::place_of(NodeId n) noexcept {
  return std::lower_bound(nodes_.begin() + static_cast<std::ptrdiff_t>(uncut_count_), nodes_.end(), n);
}

void CutSurface::settle() noexcept {
  for (const NodeId n : unsettled_) {
    is_unsettled_[static_cast<std::size_t>(n)] = false;
    const auto place = place_of(n);
    const bool listed = place != nodes_.end() && *place == n;
    const bool holds_faces = face_count_[static_cast<std::size_t>(n)] > 0;
    if (holds_faces && !listed) nodes_.insert(place, n);
    if (!holds_faces && listed) nodes_.erase(place);
  }
  unsettled_.clear();
}

SurfaceId CutSurface::surface_of(NodeId n) const noexcept {
  const std::size_t i = static_cast<std::size_t>(n);
  if (uncut_place_[i].valid() || face_count_[i] == 0) return uncut_place_[i];
  const auto bared = nodes_.begin() + static_cast<std::ptrdiff_t>(uncut_count_);
  return SurfaceId(static_cast<std::size_t>(std::lower_bound(bared, nodes_.end(), n) - nodes_.begin()));
}

}  // namespace omentum::geometry
