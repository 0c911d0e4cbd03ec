// What a law costs, and what each way of integrating it in time makes of that (Cotin 1998, section 5.4).
#pragma once

#include "organ_tools/tissue_compare/laws.h"
#include "physics/dynamics/body_state.h"

#include <string>
#include <vector>

namespace omentum::tissue_compare {

/// Seconds of one evaluation of the forces, the best of several.
double force_seconds(Law law, const Tissue& tissue);

struct IntegratorOptions {
  physics::FixedComponents fixed;  // [N]
  double damping_ratio = 0;        // of critical damping, of the fastest mode; proportional to stiffness
  double implicit_step_s = 0;
  double trial_s = 0.3;  // of computing, for each integrator
};

struct IntegratorTrial {
  std::string scheme;
  double step_s;   // 0.9 of the largest stable one; 0: there is none
  double seconds;  // of computing one, the median
  double real_time_factor() const { return seconds > 0 ? step_s / seconds : 0; }
  bool diverged;  // under gravity, within the steps that were taken
};

/// Forward Euler, symplectic Euler, Runge-Kutta 4 and an implicit step (on the kept factor; the co-rotational
/// law's is the warped one), under gravity from rest.
std::vector<IntegratorTrial> compare_integrators(Law law, const Tissue& tissue,
                                                 const IntegratorOptions& options);

}  // namespace omentum::tissue_compare
