// What an intestine and its mesentery are made of, in figures that do not depend on how finely they are
// divided.
#pragma once

namespace omentum::physics {

/// Stiffness and mass of an intestine (its gut, a tube) and its mesentery (a membrane). docs/intestine.md
/// says where the defaults come from.
struct GutMaterial {
  double gut_mass_kg_m = 0.75;          // with what is in it, per metre of gut
  double gut_stretch_n = 100;           // tension per unit strain along the gut
  double gut_bending_n_m2 = 2e-3;       // moment per curvature beyond that of rest
  double mesentery_mass_kg_m2 = 4;      // per area of the sheet
  double mesentery_stretch_n_m = 1000;  // tension per width and unit strain
  double spring_damping_s = 2e-3;       // a spring answers to where it will be after this time (Kelvin-Voigt)
  double calming_time_s = 0.25;         // in which what moves freely, without weight, is slowed to 1/e
};

/// Throws std::invalid_argument that names the member and what is expected of it: masses and stiffnesses
/// above zero, bending and damping not below it, the calming time above it (infinite: no drag); all finite.
void check(const GutMaterial& material);

}  // namespace omentum::physics
