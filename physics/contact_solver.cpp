#include "physics/contact_solver.h"

#include "geometry/precondition.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace omentum::physics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

// Sweeps between two direct solves: they only have to find out who touches and who slides. As many more as
// there were rounds before: where many points slide in one triangle the sweeps themselves must converge.
constexpr int kFirstSweeps = 4;
// Rounds before giving up. Ordinary ticks need one.
constexpr int kMaxRounds = 60;
// Normal and tangential corrections of one sliding contact per sweep; they contract fast for mu below 1.
constexpr int kSlideCorrections = 3;
// Tangential force this close to the cone (relative) counts as sliding.
constexpr double kConeEdge = 1e-9;

// Columns -n, t1, t2: a push is positive along the first.
Matrix3d local_axes(const Vec3& n) {
  const Vec3 helper = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  Matrix3d axes;
  axes.col(0) = -n;
  axes.col(1) = n.cross(helper).normalized();
  axes.col(2) = n.cross(axes.col(1));
  return axes;
}

// A contact's place among the unknowns.
struct Unknowns {
  Matrix3d axes;
  int first = 0;
  int size = 1;  // 1: frictionless, 3: with tangential forces
  bool bilateral = false;
};

class Solver {
 public:
  Solver(const ContactProblem& problem, ContactWorkspace& work) : problem_(problem), work_(work) {}

  ContactSolution solve(std::span<Vec3> forces) {
    reduce(forces);
    ContactSolution solution;
    solution.residual_m = residual();
    while (solution.rounds < kMaxRounds && std::isfinite(solution.residual_m)) {
      problem_.friction > 0 ? solve_frictional_set(solution.residual_m) : solve_frictionless_set();
      ++solution.rounds;
      solution.residual_m = residual();
      if (solution.residual_m <= kGapTolerance_m) break;
      for (int s = 0; s < kFirstSweeps + solution.rounds; ++s) sweep();
      solution.residual_m = residual();
    }
    for (int i = 0; i < problem_.count; ++i) forces[i] = force(i);
    if (!std::isfinite(solution.residual_m)) {
      std::fill_n(forces.begin(), problem_.count, Vec3::Zero());
      solution.status = ContactStatus::kNotFinite;
    } else if (solution.residual_m > kGapTolerance_m) {
      solution.status = ContactStatus::kIterationLimit;
    }
    return solution;
  }

 private:
  void reduce(std::span<const Vec3> start) {
    int m = 0;
    for (int i = 0; i < problem_.count; ++i) {
      const PointContact& c = problem_.contacts[i];
      Unknowns& u = unknowns_[i];
      u.first = m;
      u.size = c.bilateral || problem_.friction > 0 ? 3 : 1;
      u.bilateral = c.bilateral;
      if (u.size == 3)
        u.axes = local_axes(c.normal);
      else
        u.axes.col(0) = -c.normal;
      m += u.size;
    }
    work_.A.resize(m, m);
    work_.q.resize(m);
    work_.x.resize(m);
    for (int i = 0; i < problem_.count; ++i) {
      const Unknowns& a = unknowns_[i];
      for (int j = 0; j <= i; ++j) reduce_block(a, unknowns_[j], problem_.W(i, j));
      for (int d = 0; d < a.size; ++d) {
        work_.A(a.first + d, a.first + d) += kContactCompliance_m_n;
        work_.q(a.first + d) = a.axes.col(d).dot(problem_.contacts[i].free_gap);
        work_.x(a.first + d) = a.axes.col(d).dot(start[i]);
      }
      if (!a.bilateral) project(a);
    }
    refresh_gap();
  }

  void reduce_block(const Unknowns& a, const Unknowns& b, const Matrix3d& W) {
    for (int e = 0; e < b.size; ++e) {
      const Vec3 column = W * b.axes.col(e);
      for (int d = 0; d < a.size; ++d) {
        const double entry = a.axes.col(d).dot(column);
        work_.A(a.first + d, b.first + e) = entry;
        work_.A(b.first + e, a.first + d) = entry;
      }
    }
  }

  void refresh_gap() { work_.gap.noalias() = work_.q - work_.A.lazyProduct(work_.x); }

  double& x(const Unknowns& c, int d = 0) { return work_.x(c.first + d); }
  double gap(const Unknowns& c, int d = 0) const { return work_.gap(c.first + d); }
  double A(const Unknowns& c, int d = 0, int e = 0) const { return work_.A(c.first + d, c.first + e); }

  Vec3 force(int i) {
    const Unknowns& c = unknowns_[i];
    Vec3 lambda = Vec3::Zero();
    for (int d = 0; d < c.size; ++d) lambda += x(c, d) * c.axes.col(d);
    return lambda;
  }

  // The nearest tangential force inside the disc that the normal force allows.
  Vector2d onto_disc(const Vector2d& xt, double push) const {
    const double limit = problem_.friction * push, length = xt.norm();
    return length > limit ? Vector2d(xt * (limit / length)) : xt;
  }

  void project(const Unknowns& c) {
    x(c) = std::max(0.0, x(c));
    if (c.size == 3) work_.x.segment<2>(c.first + 1) = onto_disc(work_.x.segment<2>(c.first + 1), x(c));
  }

  // Tangential step size: the inverse of an upper bound of the tangential block's eigenvalues.
  double tangential_compliance(const Unknowns& c) const { return A(c, 1, 1) + A(c, 2, 2); }

  // How far a contact is from its law, as a gap: the fixed-point map's step times the compliance.
  double violation(const Unknowns& c) {
    if (c.bilateral) return work_.gap.segment<3>(c.first).norm();
    const double normal = std::abs(x(c) - std::max(0.0, x(c) + gap(c) / A(c))) * A(c);
    if (c.size == 1) return normal;
    const double a = tangential_compliance(c);
    const Vector2d xt = work_.x.segment<2>(c.first + 1), gt = work_.gap.segment<2>(c.first + 1);
    return std::max(normal, (xt - onto_disc(xt + gt / a, x(c))).norm() * a);
  }

  double residual() {
    // std::max takes a number for the larger of it and none
    if (!work_.gap.allFinite() || !work_.x.allFinite()) return std::numeric_limits<double>::infinity();
    double worst = 0;
    for (int i = 0; i < problem_.count; ++i) worst = std::max(worst, violation(unknowns_[i]));
    return worst;
  }

  void sweep() {
    for (int i = 0; i < problem_.count; ++i) {
      const Unknowns& c = unknowns_[i];
      c.size == 1 ? update_frictionless(c) : update_block(c);
    }
  }

  void update_frictionless(const Unknowns& c) {
    const double change = std::max(0.0, x(c) + gap(c) / A(c)) - x(c);
    if (change == 0) return;
    x(c) += change;
    work_.gap -= change * work_.A.row(c.first).transpose();
  }

  // The contact's own law, exactly where it sticks or opens, by a few corrections where it slides.
  void update_block(const Unknowns& c) {
    const Matrix3d own = work_.A.block<3, 3>(c.first, c.first);
    const Vec3 before = work_.x.segment<3>(c.first);
    const Vec3 b = work_.gap.segment<3>(c.first) + own * before;  // the gap without this contact's force
    const Vec3 stick = own.llt().solve(b);
    Vec3 next = stick;
    if (!c.bilateral) {
      if (b[0] <= 0) {
        next.setZero();
      } else if (stick.tail<2>().norm() > problem_.friction * stick[0]) {
        next = slide(c, own, b, before);
      }
    }
    work_.x.segment<3>(c.first) = next;
    work_.gap.noalias() -= work_.A.middleRows<3>(c.first).transpose().lazyProduct(next - before);
  }

  Vec3 slide(const Unknowns& c, const Matrix3d& own, const Vec3& b, Vec3 value) const {
    const double a = tangential_compliance(c);
    for (int s = 0; s < kSlideCorrections; ++s) {
      value[0] = std::max(0.0, (b[0] - own.block<1, 2>(0, 1).dot(value.tail<2>().transpose())) / own(0, 0));
      const Vector2d gt = b.tail<2>() - own.block<2, 3>(1, 0) * value;
      value.tail<2>() = onto_disc(value.tail<2>() + gt / a, value[0]);
    }
    return value;
  }

  // Directions of the active unknowns: a column of the active system for each. A sliding contact has one: a
  // push with its friction; its equation is the normal one.
  struct Active {
    int contact, row;     // equation
    double normal;        // share of the row's own unknown
    Vector2d tangential;  // share of the two tangential unknowns (sliding contacts)
  };

  int choose_active() {
    int count = 0;
    for (int i = 0; i < problem_.count; ++i) {
      const Unknowns& c = unknowns_[i];
      if (!c.bilateral && x(c) <= 0 && gap(c) <= 0) continue;
      if (c.size == 1 || c.bilateral) {
        for (int d = 0; d < c.size; ++d) active_[count++] = {i, c.first + d, 1, Vector2d::Zero()};
        continue;
      }
      const Vector2d xt = work_.x.segment<2>(c.first + 1);
      const double limit = problem_.friction * x(c);
      if (limit > 0 && xt.norm() >= limit * (1 - kConeEdge)) {
        active_[count++] = {i, c.first, 1, xt / x(c)};
      } else {
        for (int d = 0; d < 3; ++d) active_[count++] = {i, c.first + d, 1, Vector2d::Zero()};
      }
    }
    return count;
  }

  // Without friction the problem is a convex quadratic one: along the line to the active set's solution, as
  // far as no push becomes a pull; who would, leaves the set. Every such step lowers the energy, so that sets
  // never repeat, however redundant the contacts are.
  void solve_frictionless_set() {
    int count = choose_active();
    while (count > 0) {
      fill_active_system(count);
      work_.M.llt().solveInPlace(work_.rhs);
      double step = 1;
      int leaves = -1;
      for (int a = 0; a < count; ++a) {
        if (unknowns_[active_[a].contact].bilateral || work_.rhs(a) >= 0) continue;
        const double from = work_.x(active_[a].row), share = from / (from - work_.rhs(a));
        if (leaves < 0 || share < step) step = share, leaves = a;
      }
      for (int a = 0; a < count; ++a) {
        double& value = work_.x(active_[a].row);
        value += step * (work_.rhs(a) - value);
      }
      if (leaves < 0) break;
      work_.x(active_[leaves].row) = 0;
      active_[leaves] = active_[--count];
    }
    refresh_gap();
  }

  // With friction: closes the gaps of the active contacts exactly, sliders keeping their direction; keeps the
  // result when it is nearer to the laws than what was there.
  void solve_frictional_set(double residual_before) {
    work_.kept = work_.x;
    const int count = choose_active();
    if (count > 0) {
      fill_active_system(count);
      work_.rhs = work_.M.partialPivLu().solve(work_.rhs).eval();
    }
    work_.x.setZero();
    for (int a = 0; a < count; ++a) apply(active_[a], work_.rhs(a));
    for (int i = 0; i < problem_.count; ++i) {
      if (!unknowns_[i].bilateral) project(unknowns_[i]);
    }
    refresh_gap();
    if (residual() <= std::max(residual_before, kGapTolerance_m)) return;
    work_.x = work_.kept;
    refresh_gap();
  }

  void fill_active_system(int count) {
    work_.M.resize(count, count);
    work_.rhs.resize(count);
    for (int r = 0; r < count; ++r) {
      const int row = active_[r].row;
      work_.rhs(r) = work_.q(row);
      for (int k = 0; k < count; ++k) {
        const Active& direction = active_[k];
        double entry = work_.A(row, direction.row);
        if (direction.tangential != Vector2d::Zero()) {
          entry += work_.A(row, direction.row + 1) * direction.tangential[0] +
                   work_.A(row, direction.row + 2) * direction.tangential[1];
        }
        work_.M(r, k) = entry;
      }
    }
  }

  void apply(const Active& direction, double amount) {
    work_.x(direction.row) = amount;
    if (direction.tangential != Vector2d::Zero()) {
      work_.x.segment<2>(direction.row + 1) = amount * direction.tangential;
    }
  }

  const ContactProblem& problem_;
  ContactWorkspace& work_;
  std::array<Unknowns, kMaxContacts> unknowns_;
  std::array<Active, ContactWorkspace::kMaxUnknowns> active_;
};

}  // namespace

ContactSolution solve_contacts(const ContactProblem& problem, std::span<Vec3> forces,
                               ContactWorkspace& workspace) noexcept {
  geometry::require(problem.count >= 0 && problem.count <= kMaxContacts, "0 to kMaxContacts contacts");
  geometry::require(static_cast<int>(forces.size()) >= problem.count, "a force for each contact");
  if (problem.count == 0) return {};
  return Solver(problem, workspace).solve(forces);
}

}  // namespace omentum::physics
