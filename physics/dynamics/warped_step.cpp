#include "physics/dynamics/warped_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::physics {

namespace {

double dot(std::span<const double> a, std::span<const double> b) noexcept {
  return Eigen::Map<const Eigen::VectorXd>(a.data(), static_cast<Eigen::Index>(a.size()))
      .dot(Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size())));
}

// y += scale x
void add(double scale, std::span<const double> x, std::span<double> y) noexcept {
  for (std::size_t c = 0; c < y.size(); ++c) y[c] += scale * x[c];
}

// N s: what is less is nothing, before a factor of floats makes it zero and a division by it no number.
constexpr double kNothing = 1e-30;

// From the identity, what Q^T Q may be: a mean that is further away is none, and its node is not turned.
constexpr double kNoRotation = 0.1;

// A mean of rotations that hardly differ, once more towards the nearest rotation (Newton and Schulz). What it
// is off by costs iterations, not truth.
Eigen::Matrix3d rotation_near(const Eigen::Matrix3d& mean) noexcept {
  const Eigen::Matrix3d Q = 0.5 * mean * (3 * Eigen::Matrix3d::Identity() - mean.transpose() * mean);
  const bool found = (Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm() < kNoRotation;
  return found ? Q : Eigen::Matrix3d::Identity();
}

}  // namespace

WarpedStep::WarpedStep(const geometry::TetraMesh& mesh, const MaterialMap& material, const Inertia& inertia,
                       Corotational law, const WarpedOptions& options)
    : mesh_(mesh),
      inertia_(inertia),
      carried_(mesh, material, inertia.mass),
      law_(std::move(law)),
      added_(options.added),
      linear_(mesh, material, options.linear),
      options_(options),
      factor_(mesh, material, inertia.fixed, inertia.mass, weights_of(inertia, options.step_s),
              options.most_compliance_nodes, options.added),
      left_(mesh.tetrahedra.size(), 1),
      stands_(inertia.fixed.begin(), inertia.fixed.end()),
      ties_(inertia.mass.size()),
      rotation_(inertia.mass.size(), Eigen::Matrix3d::Identity()),
      again_(state_at_rest(inertia.mass.size())),
      linear_at_(again_),
      ahead_(3 * inertia.mass.size()),
      forces_(ahead_.size()),
      change_(ahead_.size()),
      foreseen_(ahead_.size()),
      direction_(ahead_.size()),
      product_(ahead_.size()),
      turned_(ahead_.size()),
      solved_(ahead_.size()),
      lacking_(ahead_.size()),
      residual_(ahead_.size()) {
  options_.added = {};
  options_.linear = {};
  for (std::size_t t = 0; t < left_.size(); ++t)
    if (linear_.has(geometry::TetId(t))) law_.remove(geometry::TetId(t));
  for (const geometry::NodeId n : added_.nodes()) stands_[n] = 1;
  count_ties();
}

// By tetrahedra, and by what is added, of which nothing goes.
void WarpedStep::count_ties() noexcept {
  std::ranges::fill(ties_, 0);
  for (const geometry::Tetrahedron& corners : mesh_.tetrahedra)
    for (const geometry::NodeId n : corners) ++ties_[n];
  for (const geometry::NodeId n : added_.nodes()) ++ties_[n];
}

// What is left of the mass of a node whose tissue is gone is so little that the part of an equation that a
// solution may lack would throw it out of the world: it stays where it is.
bool WarpedStep::is_held(std::size_t c) const noexcept {
  return ties_[c / 3] == 0 || is_fixed(inertia_.fixed[c / 3], static_cast<int>(c % 3));
}

bool WarpedStep::step(BodyState& state, std::span<const double> external) noexcept {
  linearize(state);
  add_impulse(external, residual_);
  enough_ = enough_of(residual_);
  if (!solve(enough_, residual_, change_)) {
    std::ranges::fill(residual_, 0.0);
    return false;
  }
  add(1, change_, state.v);
  add(options_.step_s, state.v, state.u);
  return std::isfinite(dot(state.v, state.v));
}

void WarpedStep::foresee(const BodyState& state, std::span<const double> external,
                         std::span<double> u) noexcept {
  linearize(state);
  std::ranges::copy(residual_, lacking_.begin());
  add_impulse(external, lacking_);
  // near a rest the right-hand side is a small difference of what tissue and tools do
  solve(std::max(enough_, enough_of(lacking_)), lacking_, foreseen_);
  for (std::size_t c = 0; c < u.size(); ++c)
    u[c] = state.u[c] + options_.step_s * (state.v[c] + foreseen_[c]);
}

// A step begins where the last look ahead did, unless something was removed.
void WarpedStep::linearize(const BodyState& state) noexcept {
  if (is_linear_ && state.u == linear_at_.u && state.v == linear_at_.v) return;
  std::ranges::copy(state.u, linear_at_.u.begin());
  std::ranges::copy(state.v, linear_at_.v.begin());
  for (std::size_t c = 0; c < ahead_.size(); ++c) ahead_[c] = state.u[c] + options_.step_s * state.v[c];
  law_.linearize(ahead_, Tangent::kWarped);
  mean_rotations();
  find_forces(state.v);
  is_linear_ = true;
}

void WarpedStep::find_forces(std::span<const double> v) noexcept {
  law_.forces(ahead_, forces_);
  law_.product(v, product_);
  const double b = inertia_.stiffness_damping_s;
  for (std::size_t c = 0; c < forces_.size(); ++c) {
    forces_[c] -= inertia_.mass_damping_per_s * carried_.kg()[c / 3] * v[c] + b * product_[c];
    turned_[c] = ahead_[c] + b * v[c];  // what is linear holds both at once
  }
  added_.add_product(-1, turned_, forces_);
  linear_.add_product(-1, turned_, forces_);
}

// Nodes that are held in part are not turned: a held component has to stay one. Nor are those that are tied,
// by what does not turn.
void WarpedStep::mean_rotations() noexcept {
  std::ranges::fill(rotation_, Eigen::Matrix3d::Zero());
  for (std::size_t t = 0; t < left_.size(); ++t) {
    if (left_[t] == 0) continue;
    const Eigen::Matrix3d R = law_.rotation(geometry::TetId(t));
    for (const geometry::NodeId n : mesh_.tetrahedra[t]) rotation_[n] += R;
  }
  for (std::size_t n = 0; n < rotation_.size(); ++n) {
    const double size = rotation_[n].norm();
    rotation_[n] = turns(n) && size > 0 ? rotation_near(std::sqrt(3.0) / size * rotation_[n])
                                        : Eigen::Matrix3d::Identity();
  }
}

// The right-hand side is added to what the last step lacked: all of it is lacking while dv = 0.
void WarpedStep::add_impulse(std::span<const double> external, std::span<double> lacking) noexcept {
  for (std::size_t c = 0; c < lacking.size(); ++c) {
    lacking[c] = is_held(c) ? 0.0 : lacking[c] + options_.step_s * (external[c] + forces_[c]);
  }
}

void WarpedStep::multiply(std::span<const double> x, std::span<double> y) noexcept {
  law_.product(x, y);
  added_.add_product(1, x, y);
  linear_.add_product(1, x, y);
  const SystemWeights& weights = factor_.weights();
  for (std::size_t c = 0; c < y.size(); ++c) {
    y[c] = is_held(c) ? 0.0 : weights.mass * carried_.kg()[c / 3] * x[c] + weights.stiffness * y[c];
  }
}

// x = Q A_0^-1 Q^T r
void WarpedStep::precondition(std::span<const double> residual, std::span<double> x) noexcept {
  for (std::size_t n = 0; n < rotation_.size(); ++n)
    Vec3::Map(&turned_[3 * n]) = rotation_[n].transpose() * Vec3::Map(&residual[3 * n]);
  factor_.solve_roughly(turned_, x);
  for (std::size_t n = 0; n < rotation_.size(); ++n)
    Vec3::Map(&x[3 * n]) = ties_[n] == 0 ? Vec3::Zero().eval() : (rotation_[n] * Vec3::Map(&x[3 * n])).eval();
}

double WarpedStep::enough_of(std::span<const double> right_hand_side) const noexcept {
  return std::max(kNothing, options_.tolerance * std::sqrt(dot(right_hand_side, right_hand_side)));
}

// As much of the guess x as is right; what it lacks stays in `lacking`.
void WarpedStep::start_from(std::span<double> x, std::span<double> lacking) noexcept {
  for (std::size_t n = 0; n < ties_.size(); ++n)
    if (ties_[n] == 0) Vec3::Map(&x[3 * n]).setZero();
  multiply(x, product_);
  const double length = dot(x, product_), share = length > 0 ? dot(x, lacking) / length : 0;
  for (double& value : x) value *= share;
  add(-share, product_, lacking);
}

// Conjugate gradients from the guess x, until no more than `enough` is lacking; that stays in `lacking`.
// False: it is no number, and x is zero.
bool WarpedStep::solve(double enough, std::span<double> lacking, std::span<double> x) noexcept {
  start_from(x, lacking);
  double left2 = dot(lacking, lacking), along_before = 0;
  for (iterations_ = 0; iterations_ < options_.most_iterations && left2 > enough * enough; ++iterations_) {
    precondition(lacking, solved_);
    const double along = dot(lacking, solved_);
    for (std::size_t c = 0; c < direction_.size(); ++c)
      direction_[c] = solved_[c] + (iterations_ == 0 ? 0 : along / along_before * direction_[c]);
    along_before = along;
    multiply(direction_, product_);
    const double length = along / dot(direction_, product_);
    add(length, direction_, x);
    add(-length, product_, lacking);
    left2 = dot(lacking, lacking);
  }
  if (!std::isfinite(left2)) std::ranges::fill(x, 0.0);
  return std::isfinite(left2);
}

void WarpedStep::take_off_law(std::span<const geometry::TetId> tetrahedra) noexcept {
  is_linear_ = false;
  for (const geometry::TetId t : tetrahedra) {
    if (linear_.has(t)) {
      linear_.remove(t);
    } else {
      law_.remove(t);
    }
    if (std::exchange(left_[static_cast<std::size_t>(t)], std::uint8_t{0}) == 0) continue;
    for (const geometry::NodeId n : mesh_.tetrahedra[t]) --ties_[n];
  }
}

// What goes as a whole stays in the factor, which only says where to look for a solution.
bool WarpedStep::part(const PartedTetrahedra& parted, double anchor_kg) noexcept {
  take_off_law(parted.whole);
  carried_.remove(parted.whole);
  const bool is_anchored = factor_.add_mass(parted.loose, anchor_kg);
  return remove(parted.taken) && is_anchored;
}

bool WarpedStep::give_masses(std::span<const geometry::TetId> tetrahedra,
                             std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept {
  is_linear_ = false;
  for (const geometry::TetId t : tetrahedra) {
    if (!linear_.has(t)) continue;
    linear_.remove(t);
    law_.add(t);
  }
  carried_.give(nodes, kg);
  return factor_.add_masses(nodes, kg);
}

bool WarpedStep::remove(std::span<const geometry::TetId> tetrahedra) noexcept {
  take_off_law(tetrahedra);
  // the factor, which only says where to look for a solution, keeps the mass: that is a removal less for each
  // node
  carried_.remove(tetrahedra);
  return factor_.remove(tetrahedra);
}

void WarpedStep::restore() noexcept {
  is_linear_ = false;
  for (std::size_t t = 0; t < left_.size(); ++t) {
    const geometry::TetId id(t);
    const bool has = left_[t] != 0 && !linear_.has(id);
    if (has && linear_.had(id)) law_.remove(id);
    if (!has && !linear_.had(id)) law_.add(id);
  }
  linear_.restore();
  std::ranges::fill(left_, 1);
  count_ties();
  for (auto* kept : {&residual_, &change_, &foreseen_}) std::ranges::fill(*kept, 0.0);
  factor_.restore();
  carried_.restore();
}

void WarpedStep::yield_to(std::span<const double> forces, std::span<double> yield) noexcept {
  const double dt = options_.step_s;
  for (std::size_t c = 0; c < lacking_.size(); ++c) lacking_[c] = is_held(c) ? 0.0 : dt * dt * forces[c];
  solve(enough_of(lacking_), lacking_, yield);
}

void WarpedStep::compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept {
  factor_.inverse_block(nodes, block);
  const auto scale = static_cast<float>(options_.step_s * options_.step_s);
  for (std::size_t i = 0; i < 9 * nodes.size() * nodes.size(); ++i) block[i] *= scale;
  turn(nodes, block);
}

void WarpedStep::project_at_rest(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                                 std::span<float> block) noexcept {
  factor_.project_inverse(nodes, rows, block);
  for (float& c : block) c *= static_cast<float>(options_.step_s * options_.step_s);
}

void WarpedStep::turn(std::span<const geometry::NodeId> nodes, std::span<float> block) const noexcept {
  const auto size = static_cast<Eigen::Index>(3 * nodes.size());
  using Block = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<Block> C(block.data(), size, size);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!nodes[k].valid() || !turns(static_cast<std::size_t>(nodes[k]))) continue;
    const Eigen::Matrix3f Q = rotation_[nodes[k]].cast<float>();
    const auto at = static_cast<Eigen::Index>(3 * k);
    for (Eigen::Index j = 0; j < size; j += 3) C.block<3, 3>(at, j) = (Q * C.block<3, 3>(at, j)).eval();
    for (Eigen::Index i = 0; i < size; i += 3)
      C.block<3, 3>(i, at) = (C.block<3, 3>(i, at) * Q.transpose()).eval();
  }
}

}  // namespace omentum::physics
