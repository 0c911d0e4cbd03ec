#include "render_node/back_to_front.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace omentum::render {

std::span<const MeshTriangle> BackToFront::order(const MeshData& mesh, const Vec3f& eye) {
  facing_.clear();
  ordered_.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f &p = mesh.vertices[a].position, &q = mesh.vertices[b].position,
                &r = mesh.vertices[c].position;
    if ((q - p).cross(r - p).dot(eye - p) > 0) {
      facing_.push_back({((p + q + r) / 3 - eye).squaredNorm(), t});
    } else {
      ordered_.push_back(mesh.triangles[t]);
    }
  }
  std::ranges::sort(facing_, [](const Far& one, const Far& other) {
    return one.squared_m2 != other.squared_m2 ? one.squared_m2 > other.squared_m2
                                              : one.triangle < other.triangle;
  });
  for (const Far& far : facing_) ordered_.push_back(mesh.triangles[far.triangle]);
  return ordered_;
}

}  // namespace omentum::render
