#include "organ_tools/tissue_compare/equilibrium.h"

#include <stdexcept>

namespace omentum::tissue_compare {

namespace {

using Vector = Eigen::VectorXd;

constexpr int kMostRounds = 30;
constexpr double kAtRest = 1e-6;       // free forces over those that hold
constexpr double kLinearSolve = 1e-3;  // of one round: the next one corrects it

class Relaxation {
 public:
  Relaxation(physics::ForceLaw& law, const std::vector<std::uint8_t>& held, double step, Vector& u)
      : law_(law), held_(held), step_(step), u_(u) {}

  void run() {
    for (int round = 0; round < kMostRounds; ++round) {
      const Vector all = forces(u_), free = freed(all);
      if (free.norm() <= kAtRest * (all - free).norm()) return;
      u_ += newton_step(free);
    }
    throw std::runtime_error("no equilibrium was found: the mesh is too coarse, or the material too soft");
  }

 private:
  Vector forces(const Vector& u) {
    Vector f(u.size());
    law_.forces({u.data(), held_.size()}, {f.data(), held_.size()});
    return f;
  }

  Vector freed(Vector f) const {
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      if (held_[static_cast<std::size_t>(i)] != 0) f[i] = 0;
    }
    return f;
  }

  // K d, by central differences
  Vector product(const Vector& d) {
    const double scale = step_ / d.cwiseAbs().maxCoeff();
    return freed(forces(u_ - scale * d) - forces(u_ + scale * d)) / (2 * scale);
  }

  Vector newton_step(const Vector& force) {
    Vector x = Vector::Zero(force.size()), residual = force, direction = force;
    double size2 = residual.squaredNorm();
    const double enough2 = kLinearSolve * kLinearSolve * size2;
    for (Eigen::Index i = 0; i < 3 * force.size() && size2 > enough2; ++i) {
      const Vector K_d = product(direction);
      const double curvature = direction.dot(K_d);
      if (!(curvature > 0)) break;
      const double along = size2 / curvature;
      x += along * direction;
      residual -= along * K_d;
      const double next2 = residual.squaredNorm();
      direction = residual + next2 / size2 * direction;
      size2 = next2;
    }
    return x;
  }

  physics::ForceLaw& law_;
  const std::vector<std::uint8_t>& held_;
  double step_;
  Vector& u_;
};

}  // namespace

void relax(physics::ForceLaw& law, const std::vector<std::uint8_t>& held, double step, Eigen::VectorXd& u) {
  Relaxation(law, held, step, u).run();
}

}  // namespace omentum::tissue_compare
