#include "physics/dynamics/added_forces.h"

namespace omentum::physics {

namespace {

Eigen::Index place(std::size_t k) {
  return static_cast<Eigen::Index>(3 * k);
}

}  // namespace

AddedForces::AddedForces(const AddedStiffness& added)
    : nodes_(added.nodes), stiffness_(added.K), u_(added.K.rows()), f_(added.K.rows()) {}

void AddedForces::multiply(std::span<const double> u) noexcept {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    u_.segment<3>(place(k)) = Eigen::Map<const Eigen::Vector3d>(u.data() + 3 * nodes_[k]);
  stiffness_.product({u_.data(), stiffness_.size()}, {f_.data(), stiffness_.size()});
}

void AddedForces::add_product(double scale, std::span<const double> u, std::span<double> f) noexcept {
  if (nodes_.empty()) return;
  multiply(u);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    Eigen::Map<Eigen::Vector3d>(f.data() + 3 * nodes_[k]) += scale * f_.segment<3>(place(k));
}

double AddedForces::energy(std::span<const double> u) noexcept {
  if (nodes_.empty()) return 0;
  multiply(u);
  return u_.dot(f_) / 2;
}

}  // namespace omentum::physics
