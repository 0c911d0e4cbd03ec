#include "physics/dynamics/added_forces.h"

#include <utility>

namespace omentum::physics {

namespace {

Eigen::Index place(std::size_t k) {
  return static_cast<Eigen::Index>(3 * k);
}

}  // namespace

AddedForces::AddedForces(AddedStiffness added)
    : added_(std::move(added)), u_(added_.K.rows()), f_(added_.K.rows()) {}

void AddedForces::multiply(std::span<const double> u) noexcept {
  for (std::size_t k = 0; k < added_.nodes.size(); ++k)
    u_.segment<3>(place(k)) = Eigen::Map<const Eigen::Vector3d>(u.data() + 3 * added_.nodes[k]);
  f_.noalias() = added_.K * u_;
}

void AddedForces::add_product(double scale, std::span<const double> u, std::span<double> f) noexcept {
  if (added_.nodes.empty()) return;
  multiply(u);
  for (std::size_t k = 0; k < added_.nodes.size(); ++k)
    Eigen::Map<Eigen::Vector3d>(f.data() + 3 * added_.nodes[k]) += scale * f_.segment<3>(place(k));
}

double AddedForces::energy(std::span<const double> u) noexcept {
  if (added_.nodes.empty()) return 0;
  multiply(u);
  return u_.dot(f_) / 2;
}

}  // namespace omentum::physics
