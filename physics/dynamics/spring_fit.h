// Springs along a tetrahedron's edges in place of its continuum.
#pragma once

#include "physics/element_tensors.h"

#include <array>

namespace omentum::physics {

/// A tetrahedron's edges, as pairs of its corners.
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

enum class SpringFit {
  kLeastSquares,  // to the energy of every uniform strain
  kVanGelder,     // k = E V / l^2 (van Gelder 1998)
};

/// The stiffness of one tetrahedron's six edges, [6], N/m, none below zero. A uniform strain e stretches edge
/// i of direction d_i by l_i d_i^T e d_i, so that the springs' energy is a quadratic form in e. kLeastSquares
/// takes the k_i >= 0 whose form is nearest (Frobenius) to V times the continuum's, of all those that cost a
/// uniform dilation what it costs the continuum: with c such that sum_i k_i l_i^2 = 6 E V,
///
///     sum_j (d_i . d_j)^4 k_j l_j^2 = c     for each i with k_i > 0.
///
/// Without that condition a few springs, which cannot follow the form, come out a fifth too soft.
/// Which continuum: forces along edges obey Cauchy's relation, and where directions are isotropic they know
/// one Poisson's ratio, 1/4, only. So both fits keep Young's modulus and drop the material's ratio: lambda =
/// mu = 2 E / 5. (A fit to the material's own lambda keeps its resistance to compression instead, and makes
/// tissue of ratio 0.45 three times too stiff in stretch and shear.) Energies of uniform strains in the
/// mesh of a liver, 7,000 tetrahedra: within 5 % of that continuum's, van Gelder's within 6 %.
std::array<double, 6> fit_springs(const Corners& corners, const Material& material, SpringFit fit);

}  // namespace omentum::physics
