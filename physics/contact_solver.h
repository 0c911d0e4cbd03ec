// Solves the contact problem of a tick.
#pragma once

#include "physics/contact_problem.h"

namespace omentum::physics {

enum class ContactStatus : std::uint8_t {
  kConverged,       // every law holds within kGapTolerance_m
  kIterationLimit,  // forces are inside their cones, but some gap is off by `residual_m`
  kNotFinite,       // the problem has no numbers to solve: all forces are zero
};

struct ContactSolution {
  ContactStatus status = ContactStatus::kConverged;
  int rounds = 0;         // direct solves with an active set
  double residual_m = 0;  // the largest violation of any law, expressed as a gap
};

/// The reduced problem in local axes (-n, t1, t2): one unknown per frictionless contact, three otherwise.
struct ContactWorkspace {
  static constexpr int kMaxUnknowns = 3 * kMaxContacts;
  using Square =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxUnknowns, kMaxUnknowns>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxUnknowns, 1>;

  Square A;          // [m x m] B^T (W + eps I) B
  Column q, x, gap;  // [m] B^T (p - X); unknowns; q - A x
  Square M;          // the active rows and columns of A
  Column rhs, kept;  // [active]; [m] the iterate before a direct step
};

/// `forces`: [count] lambda, in W, N; the values on entry are the start (the last tick's). Projected block
/// Gauss-Seidel that guesses the active set, a direct solve that makes the guess exact, in turns until
/// every law holds. Deterministic; no allocation.
[[nodiscard]] ContactSolution solve_contacts(const ContactProblem& problem, std::span<Vec3> forces,
                                             ContactWorkspace& workspace) noexcept;

}  // namespace omentum::physics
