// The loops over the springs of an intestine and over its band, on raw pointers: compiled for this machine's
// vector unit.
#pragma once

#include "physics/dynamics/padded_nodes.h"

#include <cstddef>

namespace omentum::physics::kernels {

/// A vector of each mass, component by component.
struct Planes {
  double *x, *y, *z;
};

/// Springs [count] between x[i] and x[i + offset].
struct SpringRun {
  std::size_t count, offset;
  const double *k, *rest;  // N/m, m; where k is 0 there is none
};

/// Of bends [count]: between x[i + 1] and the middle of x[i] and x[i + 2].
struct BendRun {
  std::size_t count;
  const double *k, *rest;
};

/// l [count]: how long each is now, m. Returns the sum of k (l - rest)^2, J, in an order that is always the
/// same.
double measure(const SpringRun& run, Planes at, double* l) noexcept;
double measure(const BendRun& run, Planes at, double* l) noexcept;

/// pull [count], N: k rest + damping k l, what has to be taken from (1 + damping) k times the length for the
/// force of a spring that was l long at the step's start.
void set_pull(std::size_t count, const double* k, const double* rest, double damping, const double* l,
              double* pull) noexcept;

/// Adds (stiffer k - pull / l) d to the forces f on both ends, d between them and l their distance.
void add_forces(const SpringRun& run, double stiffer, const double* pull, Planes at, Planes f) noexcept;
void add_forces(const BendRun& run, double stiffer, const double* pull, Planes at, Planes f) noexcept;

/// Adds k (1 - rest / l + tau d . rate / l^2) d, rate being how d changes under the velocities v.
void add_damped_forces(const SpringRun& run, double tau_s, Planes at, Planes v, Planes f) noexcept;
void add_damped_forces(const BendRun& run, double tau_s, Planes at, Planes v, Planes f) noexcept;

/// f = constant - weight x, [count].
void begin_forces(std::size_t count, Planes constant, const double* weight, Planes at, Planes f) noexcept;

/// b becomes (L D L^T)^-1 b. Rows of `lower` and columns of `upper` have `width` entries (gut_band.h).
void solve_band(std::size_t size, std::size_t width, const double* lower, const double* upper,
                const double* inverse_diagonal, PaddedNode* b) noexcept;

}  // namespace omentum::physics::kernels
