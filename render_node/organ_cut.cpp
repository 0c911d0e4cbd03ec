#include "render_node/organ_cut.h"

#include <algorithm>

namespace omentum::render {

using geometry::SurfaceId;
using geometry::TetId;

OrganCut::OrganCut(const geometry::TetraMesh& mesh, const geometry::Surface& whole,
                   std::span<const geometry::CoveredFace> covered)
    : mesh_(mesh),
      whole_(whole),
      covered_(covered.begin(), covered.end()),
      editor_(mesh, {.uncut_surface = whole.node, .covered = covered}) {}

void OrganCut::set(const RemovedSet& removed) {
  editor_.set_removed(removed.bits);
  burnt_ = removed.burnt;
}

CutShape OrganCut::shape() const {
  CutShape shape;
  shape.node.assign(editor_.surface_nodes().begin(), editor_.surface_nodes().end());
  for (const geometry::NodeId n : shape.node) shape.rest.push_back(mesh_.positions[n]);
  for (const TetId t : whole_.tetrahedron) shape.gone.push_back(editor_.is_removed(t));
  for (const geometry::CoveredFace& face : covered_) shape.gone.push_back(!is_covered(face));
  for (const geometry::SurfaceFace& face : editor_.faces()) {
    if (!face.bared) continue;
    const auto& [a, b, c] = face.nodes;
    shape.bared.push_back({editor_.surface_of(a), editor_.surface_of(b), editor_.surface_of(c)});
  }
  std::sort(shape.bared.begin(), shape.bared.end());  // whatever the order of the cuts
  shape.burnt = burnt_nodes();
  return shape;
}

bool OrganCut::is_covered(const geometry::CoveredFace& face) const {
  const auto is_gone = [this](TetId t) { return editor_.is_removed(t); };
  return !is_gone(face.behind) && std::ranges::none_of(face.by, is_gone);
}

std::vector<float> OrganCut::burnt_nodes() const {
  std::vector<float> burnt(node_count(), 0.0f);
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    if (!geometry::is_set(burnt_, TetId(t))) continue;
    for (const geometry::NodeId n : mesh_.tetrahedra[t]) {
      const SurfaceId s = editor_.surface_of(n);
      if (s.valid()) burnt[static_cast<std::size_t>(s)] = 1;
    }
  }
  return burnt;
}

}  // namespace omentum::render
