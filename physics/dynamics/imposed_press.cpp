#include "physics/dynamics/imposed_press.h"

#include "geometry/precondition.h"

#include <algorithm>

namespace omentum::physics {

using geometry::Vec3;

namespace {

// Gauss-Seidel over as few unknowns as there are tools.
constexpr int kSweeps = 50;

double along(const Press& press, std::span<const double> u) {
  double sum = 0;
  for (std::size_t i = 0; i < press.nodes.size(); ++i)
    sum += press.forces[i].dot(Eigen::Map<const Vec3>(u.data() + 3 * press.nodes[i]));
  return sum;
}

double wanted(const Press& press) {
  double sum = 0;
  for (std::size_t i = 0; i < press.nodes.size(); ++i) sum += press.forces[i].dot(press.displacements[i]);
  return sum;
}

}  // namespace

ImposedPress::ImposedPress(std::size_t node_count, std::size_t most_presses)
    : yields_(most_presses, std::vector<double>(3 * node_count)),
      pattern_(3 * node_count),
      coupling_(most_presses * most_presses),
      lacking_(most_presses),
      strength_(most_presses) {}

std::span<const double> ImposedPress::impose(Yielding& body, std::span<const Press> presses,
                                             std::span<double> u, std::span<double> v) noexcept {
  geometry::require(presses.size() <= yields_.size(), "no more presses than were said");
  count_ = presses.size();
  for (std::size_t p = 0; p < count_; ++p) {
    for (std::size_t i = 0; i < presses[p].nodes.size(); ++i)
      Vec3::Map(&pattern_[3 * presses[p].nodes[i]]) += presses[p].forces[i];
    body.yield_to(pattern_, yields_[p]);
    for (const geometry::NodeId n : presses[p].nodes) Vec3::Map(&pattern_[3 * n]).setZero();
  }
  for (std::size_t p = 0; p < count_; ++p) {
    lacking_[p] = wanted(presses[p]) - along(presses[p], u);
    for (std::size_t q = 0; q < count_; ++q) {
      coupling_[p * count_ + q] = along(presses[p], yields_[q]) + (p == q ? presses[p].own_yield_j : 0);
      lacking_[p] += presses[q].already * coupling_[p * count_ + q];
    }
  }
  solve(presses);
  for (std::size_t p = 0; p < count_; ++p) {
    const double more = strength_[p] - presses[p].already;
    if (more == 0) continue;
    for (std::size_t c = 0; c < u.size(); ++c) {
      u[c] += more * yields_[p][c];
      v[c] += more * yields_[p][c] / body.step_s();
    }
  }
  return std::span(strength_).first(count_);
}

void ImposedPress::solve(std::span<const Press> presses) noexcept {
  std::fill_n(strength_.begin(), count_, 0.0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < count_; ++p) {
      const double* row = coupling_.data() + p * count_;
      if (!(row[p] > 0)) continue;
      double rest = lacking_[p];
      for (std::size_t q = 0; q < count_; ++q) rest -= row[q] * strength_[q];
      strength_[p] =
          std::clamp(strength_[p] + rest / row[p], presses[p].least_strength, presses[p].most_strength);
    }
  }
}

}  // namespace omentum::physics
