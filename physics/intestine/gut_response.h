// Raghupathi 2004, section 4.2: displacements and velocities that take overlapping parts apart.
#pragma once

#include "physics/intestine/contact_kernels.h"
#include "physics/intestine/gut_contact.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// What is corrected: masses of a gut, behind them the balls that meet it.
struct MovingMasses {
  std::span<const geometry::Vec3> before;  // [n], in W, m: at the start of the step
  std::span<geometry::Vec3> x;             // [n], in W, m
  std::span<geometry::Vec3> v;             // [n], in W, m/s
  std::span<const double> inverse_mass;    // [n], 1/kg; 0: held
};

/// A fixed number of passes, or fewer where one corrects nothing, over all contacts, one after the other in
/// their order (Gauss-Seidel). With
/// D = sum w^2 / m and u the contact's normal, a pass corrects
///   positions by  g u w / m,  g = ((x_c2 - x_c1).u + reach) / D      (eq. 9, sign by eq. 8)
///   velocities by f u w / m,  f = ((v_c2 - v_c1).u) / D              (eq. 7)
/// where the sums of all g and of all f of a contact never fall below 0: parts push, they never pull, and
/// what one contact gave too much, because another one gave it as well, it takes back. Each correction leaves
/// linear and angular momentum as they are. Velocities are corrected where positions were. Closest points and
/// normals are those at the start of the step.
/// What a contact gave in the step before may be there already (`warm`, N s in W on its first point, one for
/// each contact): then g and f begin with it, and it is taken back as far as it was too much.
/// Friction (Coulomb): the way along each other in this step, and the velocity, are taken back as far as
/// `friction` times g and f allow.
class GutResponse {
 public:
  GutResponse(std::size_t most_contacts, std::int32_t passes, double friction);

  /// Contacts beyond the capacity are left out. No allocation.
  void solve(std::span<const GutContact> contacts, const MovingMasses& masses) noexcept {
    solve(contacts, {}, 0, masses);
  }
  void solve(std::span<const GutContact> contacts, std::span<const geometry::Vec3> warm, double step_s,
             const MovingMasses& masses) noexcept;
  /// The same for places alone, in two: what stays the same of contacts, ...
  void prepare(std::span<const GutContact> contacts, std::span<const geometry::Vec3> before,
               std::span<const double> inverse_mass) noexcept;
  /// ... and passes over them; `warm` as above, x: [n], m.
  void part(std::span<const geometry::Vec3> warm, double step_s, std::span<geometry::Vec3> x) noexcept;

  /// Between passes, for who carries pushes on (gut_carry.h), of the contacts that were prepared: [contacts],
  /// N s on the first point of each (contact_kernels.h).
  kernels::PushChange find_ways(std::span<const geometry::Vec3> pushes, double step_s,
                                std::span<geometry::Vec3> ways) const noexcept;
  void add_pushes(std::span<const geometry::Vec3> pushes, double step_s,
                  std::span<geometry::Vec3> forces) const noexcept;
  kernels::AlongWays look_along(std::span<const geometry::Vec3> ways, std::span<const geometry::Vec3> x,
                                std::span<const geometry::Vec3> yields) const noexcept;

  /// Of the newest solve: f u and what rubbed, on the contact's first point, N s, one for each contact.
  geometry::Vec3 impulse(std::size_t contact) const noexcept;
  /// Contacts that pushed.
  std::int32_t pushing() const noexcept;
  /// The largest overlap of a contact after the newest solve, m, as seen along its normal.
  double deepest_m(const MovingMasses& masses) const noexcept;

 private:
  using Row = kernels::ContactRow;
  std::vector<Row> rows_;
  std::int32_t passes_;
  double friction_;

  Row prepared(const GutContact& contact, std::span<const geometry::Vec3> before,
               std::span<const double> inverse_mass) const noexcept;
  void begin_with(std::span<const geometry::Vec3> warm, double step_s) noexcept;
  void pass(std::span<geometry::Vec3> x, double* v) noexcept;
};

}  // namespace omentum::physics
