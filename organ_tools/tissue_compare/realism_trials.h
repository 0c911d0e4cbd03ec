// How true a law is to the continuum, to a cut and to a rotation (Cotin 1998, Table 1, in numbers).
#pragma once

#include "organ_tools/tissue_compare/beam.h"

namespace omentum::tissue_compare {

/// Energies of a beam at rest under imposed displacements, over the continuum's, less one: what a hand that
/// imposes them feels wrong.
struct ContinuumErrors {
  double compression;  // its ends come nearer, its sides are free: E0 = E e^2 V / 2
  double shear;        // its whole surface goes along x by y: E0 = mu g^2 V / 2
  double bending;      // its ends tilt, its sides are free: E0 = E I k^2 L / 2 (Saint-Venant)
};

/// Strains are small, so that all laws are linear.
ContinuumErrors errors_against_continuum(Law law, const Beam& beam);

/// The share of the force under compression that is left when a slot halfway through the beam has been cut.
double force_left_by_cut(Law law, const Beam& beam);

/// The largest nodal force after a rigid quarter turn about z, over the largest one when the tissue is
/// compressed by a tenth along x, nodes where a uniform strain puts them.
double force_of_quarter_turn(Law law, const Tissue& tissue);

}  // namespace omentum::tissue_compare
