// What gives way to forces within a step, by a constant matrix.
#pragma once

#include <span>

namespace omentum::physics {

/// Backward Euler's view of a body, or of anything that is moved on likewise. Vectors are [3N], x y z of each
/// node. One thread at a time; what is noexcept allocates nothing.
class Yielding {
 public:
  virtual ~Yielding() = default;

  virtual double step_s() const = 0;
  /// Displacement of all nodes at the end of a step per force held over it, for given forces, m. What `yield`
  /// holds is a guess: the answer to forces that were nearly the same, or zeros; zero in held components.
  virtual void yield_to(std::span<const double> forces, std::span<double> yield) noexcept = 0;
};

}  // namespace omentum::physics
