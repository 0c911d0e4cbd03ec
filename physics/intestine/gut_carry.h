// What contacts do to a gut whose springs are stiff for the step.
#pragma once

#include "physics/intestine/gut_response.h"

namespace omentum::physics {

/// The implicit step of a gut's springs, whose iterations contacts come into.
class GutYield {
 public:
  /// How many of them a step has, >= 1.
  virtual int iterations() const noexcept = 0;
  /// One of them: x += A^-1 (f(x) + pushes), f all that the springs' step has besides contacts, N; both
  /// [masses], in W.
  virtual void go_downhill(std::span<const geometry::Vec3> pushes_n,
                           std::span<geometry::Vec3> x) noexcept = 0;
  /// The velocities of a step that ends at `x` under these pushes; all [masses], in W.
  virtual void end_step(std::span<const geometry::Vec3> pushes_n, std::span<const geometry::Vec3> x,
                        std::span<geometry::Vec3> v) noexcept = 0;
  /// A^-1 f: how far all masses move within a step under `forces_n`, in W; both [masses].
  virtual void yield_to(std::span<const geometry::Vec3> forces_n,
                        std::span<geometry::Vec3> yield_m) const noexcept = 0;
  /// The diagonal of A^-1, [masses], m/N; 0 where held.
  virtual std::span<const double> own_yields() const noexcept = 0;

 protected:
  ~GutYield() = default;
};

/// Impulses of contacts within the iterations of an implicit step: of all places that keep parts from coming
/// nearer the step looks for the one of least energy, x_k+1 = argmin |x - x_k - A^-1 f(x_k)|_A subject to
/// J x >= reach. Where springs and contacts balance, f + J^T lambda / dt = 0, it stays, whatever A: rest, and
/// what contacts tell, depend neither on the step nor on the iterations. (Contacts behind the last iteration
/// instead would rest where A H^-1 f balances: no force of springs, so that piles never lay still.)
/// Each iteration solves the contacts as GutResponse does, with each mass' own yield in place of dt^2 / m,
/// and goes that way as far as lowers 1/2 lambda^T J A^-1 J^T lambda - lambda^T r the most, at most all of
/// it: every one improves, and lambda stays within its cone of friction. No allocation after construction.
class GutCarry {
 public:
  GutCarry(std::int32_t masses, std::size_t all_masses, std::size_t most_contacts, double friction);

  /// `masses`: x where the iterations begin, on return with contacts, and v the step's velocities; `pushes`:
  /// N s in W on the first point of each contact, as they were in the step before, on return what they are.
  /// Overlaps there were before are kept, not widened: to undo them is no matter of forces.
  void solve(std::span<const GutContact> contacts, GutYield& yield, double step_s, const MovingMasses& masses,
             std::span<geometry::Vec3> pushes) noexcept;

 private:
  std::size_t count_;  // masses of the gut; behind them balls, which yield by their own masses
  GutResponse response_;
  std::vector<GutContact> eased_;        // contacts that ask for no more than there was
  std::vector<double> inverse_mass_;     // [all], what a mass seems to have
  std::vector<geometry::Vec3> way_;      // [contacts], of their pushes, N s
  std::vector<geometry::Vec3> aim_, x_;  // [all]: where balls want to be; scratch of an iteration
  // [all]: of contacts, N; what a way of them changes of that, N; and moves, m
  std::vector<geometry::Vec3> forces_, change_, yields_;

  void begin(std::span<const GutContact> contacts, const GutYield& yield, double step_s,
             const MovingMasses& masses) noexcept;
  void find_forces(std::span<const geometry::Vec3> pushes, double step_s,
                   std::span<geometry::Vec3> forces) const noexcept;
  void go_downhill(GutYield& yield, double step_s, const MovingMasses& masses) noexcept;
  bool find_way(std::span<const geometry::Vec3> pushes, double step_s, const MovingMasses& masses) noexcept;
  void part(const GutYield& yield, double step_s, const MovingMasses& masses,
            std::span<geometry::Vec3> pushes) noexcept;
  double best_share(const MovingMasses& masses) const noexcept;
};

}  // namespace omentum::physics
