#include "physics/hybrid/border_tie.h"

namespace omentum::physics {

BorderTie tie_border(const MeshSplit& split, const geometry::Surface& surface,
                     const geometry::Surface& boundary, std::vector<geometry::TriangleId> faces) {
  BorderTie tie{std::move(faces), {}, {}};
  std::vector<std::int32_t> place(surface.node.size(), -1);
  for (const geometry::TriangleId f : tie.faces)
    for (const geometry::SurfaceId s : surface.triangles[f]) place[static_cast<std::size_t>(s)] = 0;
  std::vector<Vec3> places;
  for (std::size_t s = 0; s < place.size(); ++s) {
    if (place[s] < 0) continue;
    place[s] = static_cast<std::int32_t>(places.size());
    tie.slaves.emplace_back(s);
    places.push_back(split.precomputed.mesh.positions[surface.node[s]]);
  }
  std::vector<std::array<std::int32_t, 3>> corners;
  for (const geometry::TriangleId f : tie.faces) {
    const auto at = [&](int i) {
      return place[static_cast<std::size_t>(surface.triangles[f][static_cast<std::size_t>(i)])];
    };
    corners.push_back({at(0), at(1), at(2)});
  }
  tie.map = tie_by_mortar(split.dynamic.mesh, boundary, places, corners);
  return tie;
}

}  // namespace omentum::physics
