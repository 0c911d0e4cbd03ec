#include "render_node/surface_shading.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace omentum::render {
namespace {

// How strongly a hollow darkens: a cone whose sides rise by 30 degrees (sine 0.5) loses most of its light.
constexpr float kHollowDarkening = 1.6f;

}  // namespace

void smooth_normals(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                    std::span<Vec3f> normals) {
  std::vector<Vec3f> sum(normals.size(), Vec3f::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3f area = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (const auto corner : {a, b, c}) sum[corner] += area;
  }
  for (std::size_t s = 0; s < normals.size(); ++s) {
    const float length = sum[s].norm();
    if (length > 0) normals[s] = sum[s] / length;
  }
}

void openness_of(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                 std::span<const Vec3f> normals, std::span<float> openness) {
  // on a closed surface each edge is met twice, so every neighbour weighs the same
  std::vector<float> rise(openness.size(), 0.0f);
  std::vector<int> neighbours(openness.size(), 0);
  const auto look = [&](int from, int to) {
    const Vec3f edge = positions[to] - positions[from];
    const float length = edge.norm();
    if (length > 0) rise[from] += normals[from].dot(edge) / length;
    ++neighbours[from];
  };
  for (const auto& [a, b, c] : triangles) {
    look(a, b), look(b, a), look(b, c), look(c, b), look(c, a), look(a, c);
  }
  for (std::size_t s = 0; s < openness.size(); ++s) {
    const float hollow =
        neighbours[s] > 0 ? std::max(0.0f, rise[s] / static_cast<float>(neighbours[s])) : 0.0f;
    openness[s] = std::max(kDeepestOpenness, 1.0f - kHollowDarkening * hollow);
  }
}

}  // namespace omentum::render
