// The passes over contacts of an intestine, on raw pointers: compiled for this machine's vector unit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace omentum::physics::kernels {

/// A contact as the passes of GutResponse (gut_response.h) need it. `weight` of the second point is negative,
/// `yield` is weight over mass; the first `count` are used. Vectors are in W.
struct ContactRow {
  static constexpr std::size_t kMost = 6;

  double normal[3];
  double offset;         // separation along the normal that is asked for, m
  double per_D;          // 1 / D, kg; 0 where nothing can give way
  double g, f;           // sums over the passes, kg m and N s
  double rubbed_way[3];  // the same along each other
  double rubbed_speed[3];
  double before[3];         // of its first point from its second, at the start of the step, m
  double wall_velocity[3];  // of what has no mass, m/s
  double weight[kMost], yield[kMost];
  std::int32_t mass[kMost];
  std::int32_t count;
};

/// What a pass corrects by less is none: far below what can be seen or measured.
constexpr double kUnmoved_m = 1e-8, kUnmoved_m_s = 1e-6;

/// One pass over rows [count] in their order: of places x [masses][3], m, and of velocities v, likewise, m/s,
/// where v is not null. Friction's coefficient; 0: none. Returns whether it corrected anything.
bool correct_contacts(std::size_t count, ContactRow* rows, double friction, double* x, double* v) noexcept;

}  // namespace omentum::physics::kernels
