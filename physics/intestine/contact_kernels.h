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

/// Rows begin with what each contact gave in the step before: `warm` [count][3], N s.
void begin_contacts(std::size_t count, ContactRow* rows, const double* warm, double step_s) noexcept;

/// Of pushes [count][3], N s on the first point of each contact.
struct PushChange {
  double change_n_s, total_n_s;  // sums of lengths
};
/// What passes over places made of them, less what they were: `ways` [count][3], N s.
PushChange find_ways(std::size_t count, const ContactRow* rows, const double* pushes, double step_s,
                     double* ways) noexcept;
/// forces [masses][3] += J^T pushes / step, N.
void add_pushes(std::size_t count, const ContactRow* rows, const double* pushes, double step_s,
                double* forces) noexcept;

/// Of E(s) = s^2 cost / 2 - s gain along all ways together, J s. `x`: [masses][3], m, where s is 0; `yields`:
/// likewise, what they move within s = 1. What pushes is to close the contact, what rubs is to end where it
/// began.
struct AlongWays {
  double gain, cost;
};
AlongWays look_along(std::size_t count, const ContactRow* rows, const double* ways, const double* x,
                     const double* yields) noexcept;

}  // namespace omentum::physics::kernels
