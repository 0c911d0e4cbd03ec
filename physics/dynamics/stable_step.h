// How large a step an explicit scheme can take.
#pragma once

#include "physics/dynamics/explicit_step.h"

namespace omentum::physics {

/// The fastest oscillation of a body.
struct HighestFrequency {
  double rad_s = 0;     // from above: by 1 % at most, where `evaluations` stayed below the limit
  int evaluations = 0;  // forces that were asked for
};

/// The square root of the largest eigenvalue of M^-1 K over the free components, about the displacements at
/// rest, by power iteration from a fixed start; until its residual, which is added, is below 2 % of the
/// eigenvalue, or `most` evaluations. Removing tetrahedra only lowers it: K loses a positive part, and the
/// mass stays.
HighestFrequency highest_frequency(ForceLaw& law, const Inertia& inertia, int most = 5000);

/// The largest step, s, at which no mode up to `highest_rad_s` grows under `scheme` and the damping of
/// `inertia`. Zero for forward Euler without damping. Runge-Kutta's is the largest for the least favourable
/// share of damping, where there is any.
double stable_step_s(ExplicitScheme scheme, const Inertia& inertia, double highest_rad_s);

}  // namespace omentum::physics
