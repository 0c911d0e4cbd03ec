// Linear elastic, isotropic material.
#pragma once

namespace omentum::physics {

/// SI throughout. Preconditions checked where a material is read: young > 0, -1 < poisson < 0.5, density > 0.
struct Material {
  double young_pa = 0;
  double poisson = 0;
  double density_kg_m3 = 0;

  /// Lame's first coefficient, Pa: E nu / ((1 + nu)(1 - 2 nu)).
  double lambda() const { return young_pa * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  /// Shear modulus, Pa: E / (2 (1 + nu)).
  double mu() const { return young_pa / (2 * (1 + poisson)); }
};

}  // namespace omentum::physics
