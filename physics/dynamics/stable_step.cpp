#include "physics/dynamics/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace omentum::physics {

namespace {

using Values = std::vector<double>;

constexpr double kResidual = 0.02;  // of the eigenvalue: 1 % of the frequency
// Displacements of the iteration, m: so small that rotations of an element show in no law, and large in
// float.
constexpr double kProbe_m = 1e-6;
// Where the four slopes of Runge-Kutta damp: on the imaginary axis, and the nearest boundary of the region in
// the whole left half plane (at 122 degrees).
constexpr double kRungeKuttaUndamped = 2 * std::numbers::sqrt2;
constexpr double kRungeKuttaDamped = 2.615;

Values free_scales(const Inertia& inertia) {
  Values scale(3 * inertia.mass.size(), 0);
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (!is_fixed(inertia.fixed[i / 3], static_cast<int>(i % 3)))
      scale[i] = 1 / std::sqrt(inertia.mass[i / 3]);
  }
  return scale;
}

double norm(const Values& x) {
  double square = 0;
  for (const double component : x) square += component * component;
  return std::sqrt(square);
}

// The larger rate of decay of a mode that creeps back without swinging, or how fast it swings, 1/s:
// |lambda| of lambda^2 + c lambda + w^2 = 0 with the larger modulus.
double fastest_rate(double c, double w) {
  const double creep = c * c - 4 * w * w;
  return creep > 0 ? (c + std::sqrt(creep)) / 2 : w;
}

double forward_euler_limit(double a, double c, double w) {
  // a mode that swings shrinks while w^2 dt < c, one that creeps while dt < 2 / |lambda|; with Rayleigh's
  // damping the slowest or the fastest mode is the worst
  const double creeping = 2 / std::max(a, c * c > 4 * w * w ? fastest_rate(c, w) : 0);
  return std::min(c / (w * w), creeping);
}

double symplectic_euler_limit(double a, double b, double w) {
  // z^2 (1 + a dt) - z (2 + (a - b w^2) dt - w^2 dt^2) + 1 - b w^2 dt: no root outside the circle
  const double s = b * w * w - a;
  return 4 / (s + std::sqrt(s * s + 4 * w * w));
}

}  // namespace

HighestFrequency highest_frequency(ForceLaw& law, const Inertia& inertia, int most) {
  const Values scale = free_scales(inertia);
  Values x(scale.size()), u(scale.size()), f(scale.size());
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  std::ranges::generate(x, [&] { return normal(generator); });
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= scale[i] > 0 ? 1 : 0;
  // a unit vector of the scaled space moves the node with the least mass by at most the probe
  const double reach = kProbe_m / *std::ranges::max_element(scale);
  HighestFrequency found;
  double eigenvalue = 0, residual = std::numeric_limits<double>::infinity();
  while (found.evaluations < most && residual > kResidual * eigenvalue) {
    const double size = norm(x);
    if (size == 0) return found;
    for (std::size_t i = 0; i < x.size(); ++i) u[i] = reach * scale[i] * (x[i] /= size);
    law.forces(u, f);
    ++found.evaluations;
    eigenvalue = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      f[i] *= -scale[i] / reach;
      eigenvalue += x[i] * f[i];
    }
    residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i) residual += std::pow(f[i] - eigenvalue * x[i], 2);
    residual = std::sqrt(residual);
    x.swap(f);
  }
  found.rad_s = std::sqrt(eigenvalue + residual);
  return found;
}

double stable_step_s(ExplicitScheme scheme, const Inertia& inertia, double highest_rad_s) {
  const double a = inertia.mass_damping_per_s, b = inertia.stiffness_damping_s, w = highest_rad_s;
  const double c = a + b * w * w;
  if (w <= 0) return std::numeric_limits<double>::infinity();
  switch (scheme) {
    case ExplicitScheme::kForwardEuler:
      return forward_euler_limit(a, c, w);
    case ExplicitScheme::kSymplecticEuler:
      return symplectic_euler_limit(a, b, w);
    case ExplicitScheme::kRungeKutta4:
      break;
  }
  return c > 0 ? kRungeKuttaDamped / std::max(a, fastest_rate(c, w)) : kRungeKuttaUndamped / w;
}

}  // namespace omentum::physics
