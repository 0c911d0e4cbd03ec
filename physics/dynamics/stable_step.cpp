#include "physics/dynamics/stable_step.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace omentum::physics {

namespace {

constexpr double kResidual = 0.02;  // of the eigenvalue: 1 % of the frequency
// Displacements of the iteration, m: so small that rotations of an element show in no law, and large in
// float.
constexpr double kProbe_m = 1e-6;
// Where the four slopes of Runge-Kutta damp: on the imaginary axis, and the nearest boundary of the region in
// the whole left half plane (at 122 degrees).
constexpr double kRungeKuttaUndamped = 2 * std::numbers::sqrt2;
constexpr double kRungeKuttaDamped = 2.615;

Eigen::VectorXd free_scales(const Inertia& inertia) {
  Eigen::VectorXd scale(static_cast<Eigen::Index>(3 * inertia.mass.size()));
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const auto node = static_cast<std::size_t>(i / 3);
    scale[i] = is_fixed(inertia.fixed[node], static_cast<int>(i % 3)) ? 0 : 1 / std::sqrt(inertia.mass[node]);
  }
  return scale;
}

// M^-1/2 K M^-1/2 over the free components: symmetric, with the eigenvalues of M^-1 K.
class ScaledStiffness {
 public:
  ScaledStiffness(ForceLaw& law, const Inertia& inertia)
      : law_(law), scale_(free_scales(inertia)), u_(scale_.size()), f_(scale_.size()) {
    // a unit vector moves the node with the least mass by the probe at most
    reach_ = kProbe_m / scale_.maxCoeff();
  }

  bool anything_free() const { return scale_.maxCoeff() > 0; }

  Eigen::VectorXd any_unit_vector() const {
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    const Eigen::VectorXd any =
        Eigen::VectorXd::NullaryExpr(scale_.size(), [&] { return normal(generator); });
    return (scale_.array() > 0).select(any, 0).normalized();
  }

  const Eigen::VectorXd& times(const Eigen::VectorXd& x) {
    u_ = reach_ * scale_.cwiseProduct(x);
    const auto size = static_cast<std::size_t>(u_.size());
    law_.forces({u_.data(), size}, {f_.data(), size});
    f_ = f_.cwiseProduct(scale_) / -reach_;
    return f_;
  }

 private:
  ForceLaw& law_;
  Eigen::VectorXd scale_, u_, f_;  // [3N]
  double reach_;
};

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
  ScaledStiffness A(law, inertia);
  HighestFrequency found;
  if (!A.anything_free()) return found;
  Eigen::VectorXd x = A.any_unit_vector();
  double eigenvalue = 0, residual = std::numeric_limits<double>::infinity();
  while (found.evaluations < most && residual > kResidual * eigenvalue) {
    const Eigen::VectorXd& Ax = A.times(x);
    ++found.evaluations;
    eigenvalue = x.dot(Ax);
    residual = (Ax - eigenvalue * x).norm();
    x = Ax.normalized();
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
