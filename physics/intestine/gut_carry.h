// What contacts do to a gut whose springs are stiff for the step.
#pragma once

#include "physics/intestine/gut_response.h"

namespace omentum::physics {

/// How a gut's springs answer to forces within a step, as an implicit step has it.
class GutYield {
 public:
  /// A^-1 f: how far all masses move within a step under `forces_n`, in W; both [masses].
  virtual void yield_to(std::span<const geometry::Vec3> forces_n,
                        std::span<geometry::Vec3> yield_m) const noexcept = 0;
  /// The diagonal of A^-1, [masses], m/N; 0 where held.
  virtual std::span<const double> own_yields() const noexcept = 0;

 protected:
  ~GutYield() = default;
};

/// Impulses of contacts that keep parts from coming nearer, with the springs' answer: the displacements are
/// A^-1 J^T lambda / dt, so that a push upon a light mass in a taut mesentery is carried on by it within the
/// step. (With 1/m alone such a mass gives way by itself and is back with the next step: it trembles, and
/// what leans on it sinks.) Each round solves the contacts as GutResponse does, with each mass' own yield in
/// place of dt^2 / m, and goes that way as far as lowers 1/2 lambda^T J A^-1 J^T lambda - lambda^T r the
/// most, at most all of it: every round improves, and lambda >= 0 stays. No allocation after construction.
class GutCarry {
 public:
  GutCarry(std::int32_t masses, std::size_t all_masses, std::size_t most_contacts);

  /// `masses`: as predicted without contacts, on return with them; `lambda`: N s, one for each contact, as
  /// they were in the step before, on return what they are. Overlaps there were before are kept, not widened:
  /// to undo them is no matter of forces.
  void solve(std::span<const GutContact> contacts, const GutYield& yield, double step_s,
             const MovingMasses& masses, std::span<double> lambda) noexcept;

 private:
  std::size_t count_;  // masses of the gut; others do not yield
  GutResponse response_;
  std::vector<GutContact> eased_;                // contacts that ask for no more than there was
  std::vector<double> inverse_mass_;             // [all], what a mass seems to have
  std::vector<double> way_;                      // [contacts], of lambda, N s
  std::vector<geometry::Vec3> x_, v_;            // [all], scratch of a round
  std::vector<geometry::Vec3> forces_, yields_;  // [masses]

  void ease(std::span<const GutContact> contacts, const MovingMasses& masses) noexcept;
  void find_yields(std::span<const double> lambda, const GutYield& yield, double step_s) noexcept;
  void move(double share, double step_s, const MovingMasses& masses) const noexcept;
  double best_share(double step_s, const MovingMasses& masses) const noexcept;
};

}  // namespace omentum::physics
