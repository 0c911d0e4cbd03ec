#include "physics/hybrid/connection.h"

#include <algorithm>

namespace omentum::physics {

namespace {

std::size_t first_component(geometry::NodeId n) {
  return 3 * static_cast<std::size_t>(n);
}

}  // namespace

Connection::Connection(const MeshSplit& split, const geometry::Surface& surface, const BorderTie* tie) {
  if (tie != nullptr) {
    nodes_ = tie->slaves;
    leaders_ = tie->map.masters;
    weights_ = tie->map.P;
  } else {
    for (const geometry::NodeId n : split.connection) {
      nodes_.push_back(surface.of_node[split.precomputed.own_node[n]]);
      leaders_.push_back(split.dynamic.own_node[n]);
    }
  }
  led_.resize(3 * leaders_.size());
}

AddedStiffness Connection::added(const Eigen::MatrixXd& S) const {
  if (!is_tied()) return {leaders_, S};
  return tied({leaders_, weights_}, S);
}

std::vector<double> Connection::carried(std::span<const double> mass) const {
  if (!is_tied()) return {mass.begin(), mass.end()};
  std::vector<double> sums(leaders_.size());
  for (Eigen::Index c = 0; c < weights_.rows(); ++c)
    for (Eigen::Index m = 0; m < weights_.cols(); ++m)
      sums[static_cast<std::size_t>(m)] += weights_(c, m) * mass[static_cast<std::size_t>(c)];
  return sums;
}

void Connection::lead(std::span<const double> u, std::span<const double> v, double b,
                      std::span<double> w_c) noexcept {
  for (std::size_t m = 0; m < leaders_.size(); ++m) {
    const std::size_t at = first_component(leaders_[m]);
    for (std::size_t i = 0; i < 3; ++i) led_[3 * m + i] = u[at + i] + b * v[at + i];
  }
  if (!is_tied()) {
    std::ranges::copy(led_, w_c.begin());
    return;
  }
  for (Eigen::Index c = 0; c < weights_.rows(); ++c) {
    Vec3 w = Vec3::Zero();
    for (Eigen::Index m = 0; m < weights_.cols(); ++m)
      w += weights_(c, m) * Eigen::Map<const Vec3>(led_.data() + 3 * m);
    Eigen::Map<Vec3>(w_c.data() + 3 * c) = w;
  }
}

void Connection::gather(std::span<const double> f_c, std::span<double> f_m) const noexcept {
  if (!is_tied()) {
    std::ranges::copy(f_c, f_m.begin());
    return;
  }
  std::ranges::fill(f_m, 0.0);
  for (Eigen::Index c = 0; c < weights_.rows(); ++c) {
    const Vec3 f(f_c.data() + 3 * c);
    for (Eigen::Index m = 0; m < weights_.cols(); ++m)
      Eigen::Map<Vec3>(f_m.data() + 3 * m) += weights_(c, m) * f;
  }
}

void Connection::add_gathered(std::span<const double> f_c, std::span<double> f) noexcept {
  gather(f_c, led_);
  for (std::size_t m = 0; m < leaders_.size(); ++m)
    for (std::size_t i = 0; i < 3; ++i) f[first_component(leaders_[m]) + i] += led_[3 * m + i];
}

}  // namespace omentum::physics
