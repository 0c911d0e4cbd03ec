#include "physics/element_tensors.h"

namespace omentum::physics {

std::array<Vec3, 4> area_normals(const Corners& corners) {
  std::array<Vec3, 4> M;
  for (int j = 0; j < 4; ++j) {
    const Vec3& a = corners[(j + 1) % 4];
    const Vec3& b = corners[(j + 2) % 4];
    const Vec3& c = corners[(j + 3) % 4];
    const double sign = j % 2 == 0 ? 1 : -1;
    M[j] = sign * (b - a).cross(c - a);
  }
  return M;
}

ElementTensors element_tensors(const Corners& corners, const Material& material) {
  const double V = geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]);
  const double lambda = material.lambda(), mu = material.mu();
  const std::array<Vec3, 4> M = area_normals(corners);
  ElementTensors K;
  for (int j = 0; j < 4; ++j) {
    for (int k = j; k < 4; ++k) {
      K[j][k] = lambda * M[j] * M[k].transpose() + mu * M[k] * M[j].transpose();
      K[j][k].diagonal().array() += mu * M[j].dot(M[k]);
      K[j][k] /= 36 * V;
      if (k != j) K[k][j] = K[j][k].transpose();
    }
  }
  return K;
}

Corners corners_of(const geometry::TetraMesh& mesh, geometry::TetId t) {
  const geometry::Tetrahedron& nodes = mesh.tetrahedra[t];
  return {mesh.positions[nodes[0]], mesh.positions[nodes[1]], mesh.positions[nodes[2]],
          mesh.positions[nodes[3]]};
}

}  // namespace omentum::physics
