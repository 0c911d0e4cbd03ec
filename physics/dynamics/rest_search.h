// Where a body of any law comes to rest.
#pragma once

#include "physics/dynamics/force_law.h"
#include "physics/dynamics/kept_factor.h"

#include <vector>

namespace omentum::physics {

struct RestOptions {
  int most_iterations = 2000;
  /// At rest: no free component's force is larger than this part of the largest that any node met.
  double balance = 1e-10;
  /// Where it gets no nearer to that, this will do: a law may round its forces by what they are of a large
  /// strain.
  double rounding = 1e-7;
};

/// Changes the free components of `u`, [3N], until the law's forces balance `external`, [3N], N: descends
/// E(u) - f . u by L-BFGS (Nocedal 1980), whose first guess of the inverse stiffness is the kept factor's, so
/// that a linear law takes one step and what turns a few dozen (Liu, Bouaziz and Kavan 2017). Every step
/// lowers the energy, whatever the law: steps in time on a factor that is not the law's own need not. False:
/// it found no balance. Allocates.
[[nodiscard]] bool search_rest(ForceLaw& law, KeptFactor& factor, std::span<const double> external,
                               std::vector<double>& u, const RestOptions& options = {});

}  // namespace omentum::physics
