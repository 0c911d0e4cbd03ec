#include "physics/dynamics/element_root.h"

#include <cmath>

namespace omentum::physics {

ElementRoot element_root(const Corners& corners, const Material& material) {
  const double V = geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]);
  const double lambda = material.lambda(), mu = material.mu();
  const std::array<Vec3, 4> M = area_normals(corners);

  // of the normal strains' part of D, 2 mu I + lambda 1 1^T: it acts on their mean and on the rest apart
  const double rest = std::sqrt(2 * mu);
  const double mean = (std::sqrt(2 * mu + 3 * lambda) - rest) / 3;
  const double shear = std::sqrt(mu);
  ElementRoot W;
  for (int j = 0; j < 4; ++j) {
    const Vec3 g = -M[j] / (6 * V);  // the gradient of the corner's shape function
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3;
      for (int k = 0; k < 3; ++k) {
        W(3 * j + i, k) = g[i] * (mean + (k == i ? rest : 0));
        // column 3 + k: the shear between axes k and k + 1
        W(3 * j + i, 3 + k) = k == i ? shear * g[next] : (k + 1) % 3 == i ? shear * g[k] : 0;
      }
    }
  }
  return std::sqrt(V) * W;
}

}  // namespace omentum::physics
