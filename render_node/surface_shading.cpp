#include "render_node/surface_shading.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

// Steps of diffusion: they grow with the square of horizon over edge.
constexpr float kMostSteps = 16;

float mean_edge(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += (positions[b] - positions[a]).norm() + (positions[c] - positions[b]).norm() +
           (positions[a] - positions[c]).norm();
  }
  return triangles.empty() ? 0 : static_cast<float>(sum / (3 * static_cast<double>(triangles.size())));
}

// Every node goes to the mean of its neighbours; on a closed surface each is met twice, so all weigh the
// same.
void diffuse(std::span<const geometry::Triangle> triangles, std::vector<Vec3f>& positions) {
  std::vector<Vec3f> sum(positions.size(), Vec3f::Zero());
  std::vector<float> count(positions.size(), 0.0f);
  for (const auto& [a, b, c] : triangles) {
    sum[a] += positions[b] + positions[c];
    sum[b] += positions[c] + positions[a];
    sum[c] += positions[a] + positions[b];
    for (const auto corner : {a, b, c}) count[corner] += 2;
  }
  for (std::size_t s = 0; s < positions.size(); ++s) {
    if (count[s] > 0) positions[s] = sum[s] / count[s];
  }
}

}  // namespace

int diffusion_steps(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions,
                    float horizon_m) {
  const float edge = mean_edge(triangles, positions);
  if (!(edge > 0)) return 0;
  return static_cast<int>(std::clamp(std::ceil(horizon_m * horizon_m / (edge * edge)), 1.0f, kMostSteps));
}

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
                 std::span<const Vec3f> normals, float horizon_m, std::span<float> openness) {
  const int steps = diffusion_steps(triangles, positions, horizon_m);
  std::vector<Vec3f> surroundings(positions.begin(), positions.end());
  for (int step = 0; step < steps; ++step) diffuse(triangles, surroundings);
  for (std::size_t s = 0; s < openness.size(); ++s)
    openness[s] = openness_below(normals[s].dot(surroundings[s] - positions[s]), horizon_m);
}

}  // namespace omentum::render
