// Whether a body has more energy than was ever put into it.
#pragma once

namespace omentum::deform {

/// A body's energy is the work done on it since it was at rest, less what damping and cuts took: more, and
/// the integration is making it. A symplectic step near its limit shows a mode's energy up to this many times
/// as large as it is, which is no fault.
class EnergyLedger {
 public:
  static constexpr double kSlack = 20;
  /// Below this no eye and no hand finds a motion, J: a gram at 1 mm/s.
  static constexpr double kUnnoticed_j = 5e-10;

  void reset() noexcept { work_j_ = 0; }
  void add_work(double work_j) noexcept { work_j_ += work_j; }
  /// False for an energy that cannot be, or is no number.
  bool allows(double energy_j) const noexcept { return energy_j <= kSlack * work_j_ + kUnnoticed_j; }

 private:
  double work_j_ = 0;
};

}  // namespace omentum::deform
