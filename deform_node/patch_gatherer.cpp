#include "deform_node/patch_gatherer.h"

namespace omentum::deform {

using geometry::NodeId;
using geometry::Vec3;

namespace {

struct DeformedFaces {
  const geometry::TetraMesh& mesh;
  std::span<const geometry::SurfaceFace> faces;
  std::span<const double> u;

  std::size_t count() const noexcept { return faces.size(); }
  const auto& corners(std::size_t f) const noexcept { return faces[f].nodes; }
  bool is_one(std::size_t /*f*/) const noexcept { return true; }
  Vec3 place(NodeId n) const noexcept { return mesh.positions[n] + Eigen::Map<const Vec3>(u.data() + 3 * n); }
};

}  // namespace

PatchGatherer::PatchGatherer(const geometry::TetraMesh& mesh, std::size_t most_nodes)
    : mesh_(mesh), choice_(mesh.positions.size(), 4 * mesh.tetrahedra.size(), most_nodes) {}

bool PatchGatherer::gather(const PatchPlace& place, const geometry::MeshEditor& editor,
                           std::span<const double> u, LocalPatch& patch) noexcept {
  if (!choice_.choose(place, DeformedFaces{mesh_, editor.faces(), u}, patch)) return false;
  for (std::size_t i = 0; i < nodes().size(); ++i)
    patch.nodes[i] = static_cast<std::uint32_t>(mesh_.file_node[nodes()[i]]);
  return true;
}

}  // namespace omentum::deform
