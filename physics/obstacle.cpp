#include "physics/obstacle.h"

#include <Eigen/Cholesky>

#include <vector>

namespace omentum::physics {

namespace {

// A force or a gap below this part of the largest one is zero.
constexpr double kSolveRounding = 1e-10;
// Whole blocks are exchanged that often without getting nearer before Murty's rule, one at a time, takes
// over.
constexpr int kBlockTries = 5;
// Rounds for each place: Murty's rule seldom takes more than two, but rounding of a nearly singular matrix
// may send a place to and fro for ever.
constexpr std::size_t kRoundsPerPlace = 50;

class Pivoting {
 public:
  Pivoting(const Eigen::MatrixXd& compliance, const Eigen::VectorXd& depth)
      : compliance_(compliance), depth_(depth), touches_(static_cast<std::size_t>(depth.size())) {
    for (Eigen::Index i = 0; i < depth_.size(); ++i) touches_[static_cast<std::size_t>(i)] = depth_[i] > 0;
  }

  std::optional<Eigen::VectorXd> solve() {
    std::size_t fewest = touches_.size() + 1;
    int tries = kBlockTries;
    for (std::size_t round = 0; round < kRoundsPerPlace * touches_.size() && push(); ++round) {
      std::vector<std::size_t> wrong = wrong_places();
      if (wrong.empty()) return force_;
      if (wrong.size() < fewest) {
        fewest = wrong.size();
        tries = kBlockTries;
      } else if (--tries < 0) {
        wrong = {wrong.back()};
      }
      for (const std::size_t i : wrong) touches_[i] = !touches_[i];
    }
    return std::nullopt;
  }

 private:
  // p of what touches, the rest free.
  bool push() {
    std::vector<Eigen::Index> active;
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      if (touches_[i]) active.push_back(static_cast<Eigen::Index>(i));
    }
    force_ = Eigen::VectorXd::Zero(depth_.size());
    if (active.empty()) return true;
    const Eigen::LLT<Eigen::MatrixXd> factor(compliance_(active, active));
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd depth = depth_(active), force = factor.solve(depth);
    force_(active) = force;
    return force_.allFinite();
  }

  // Where the obstacle would have to pull, or the body is inside it.
  std::vector<std::size_t> wrong_places() const {
    const Eigen::VectorXd gap = compliance_ * force_ - depth_;
    const double least_force = -kSolveRounding * force_.cwiseAbs().maxCoeff();
    const double least_gap = -kSolveRounding * depth_.cwiseAbs().maxCoeff();
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (touches_[i] ? force_[at] < least_force : gap[at] < least_gap) wrong.push_back(i);
    }
    return wrong;
  }

  const Eigen::MatrixXd& compliance_;
  const Eigen::VectorXd& depth_;
  std::vector<bool> touches_;
  Eigen::VectorXd force_;
};

}  // namespace

std::optional<Eigen::VectorXd> clear_obstacle(const Eigen::MatrixXd& compliance,
                                              const Eigen::VectorXd& depth) {
  if (depth.size() == 0) return Eigen::VectorXd();
  return Pivoting(compliance, depth).solve();
}

}  // namespace omentum::physics
