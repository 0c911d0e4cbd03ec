// Which forces keep rigid points out of an elastic surface: unilateral contact with Coulomb friction, on the
// compliance of the contact points.
#pragma once

#include "geometry/types.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace omentum::physics {

using geometry::Vec3;

/// Contacts that one problem can hold: four instruments of eight points.
inline constexpr int kMaxContacts = 32;

/// A gap below this is closed, m: a thousandth of what a fingertip feels as a step, ten thousand times above
/// the rounding of displacements that are stored in float.
inline constexpr double kGapTolerance_m = 1e-6;

/// Compliance of the contact itself, m/N, added to every contact's own block: a thousandth of a soft organ's.
/// It keeps the problem regular where all vertices are pinned, and shares the force between points that the
/// surface cannot tell apart (eight points in one triangle).
inline constexpr double kContactCompliance_m_n = 1e-6;

/// A tool's point that holds a material point of the surface.
struct PointContact {
  Vec3 normal = Vec3::UnitZ();   // outward, unit: tissue pushes along it and never pulls
  Vec3 free_gap = Vec3::Zero();  // p - X: tool point minus rest position of the material point, m
  bool bilateral = false;        // grasped: sticks and may pull
  std::int32_t body = 0;         // the rigid tool that the point belongs to
  // the stiffest wall that the tool's device renders, N/m
  double max_stiffness_n_m = std::numeric_limits<double>::infinity();
};

/// For every contact i, with lambda_i the force on the tissue and the gap
///     r_i = p_i - X_i - sum_j W_ij lambda_j - eps lambda_i:
/// unilateral: 0 <= -lambda.n, 0 <= r.n, one of them zero (Signorini); |lambda_t| <= mu (-lambda.n), and
/// where r_t is not zero lambda_t = mu (-lambda.n) r_t / |r_t| (Coulomb: the sliding tool drags the tissue
/// along). Bilateral: r = 0. mu = 0 is frictionless: lambda along n only. The imposed displacement of Cotin
/// 1999, section 3-3, is the sticking case (docs/design.md, "Contact").
struct ContactProblem {
  int count = 0;        // 0 .. kMaxContacts
  double friction = 0;  // mu >= 0
  std::array<PointContact, kMaxContacts> contacts;
  std::array<Eigen::Matrix3d, kMaxContacts * kMaxContacts>
      compliance;                           // W_ij = J C_AA J^T, m/N, symmetric as a whole
  std::array<double, kMaxContacts> root_c;  // sqrt(c_i) of limit_stiffness

  Eigen::Matrix3d& W(int i, int j) { return compliance[static_cast<std::size_t>(i) * kMaxContacts + j]; }
  const Eigen::Matrix3d& W(int i, int j) const {
    return compliance[static_cast<std::size_t>(i) * kMaxContacts + j];
  }
};

/// Puts the spring of a tool's device between the tool and what is stiffer than it (a pinned surface, where W
/// is zero): within a body
///     W_ij += sqrt(c_i c_j) I,  c_i = max(0, 1 / k_max - n_i . W_ii n_i).
/// Points where the surface is softer than k_max keep their compliance, bit for bit. Those where it is not
/// move the one spring together, so that a body pressed into a rigid wall feels k_max however many points
/// touch; and c_i follows the point alone, so that no force jumps when another point begins to touch. Stays
/// symmetric and positive semidefinite. No allocation.
void limit_stiffness(ContactProblem& problem) noexcept;
/// The same for contact i against itself and the first `columns`, which have theirs.
void limit_stiffness(ContactProblem& problem, int i, int columns) noexcept;

/// r_i under the forces of the first contacts, m. `forces`: lambda, N; the others' are zero.
Vec3 gap_of(const ContactProblem& problem, std::span<const Vec3> forces, int i) noexcept;

}  // namespace omentum::physics
