// Nothing but loops on raw pointers and no library header with inline functions: compiled for this machine's
// vector unit (omentum_native).
#include "physics/dynamics/spring_kernel.h"

#include "physics/dynamics/lanes.h"

namespace omentum::physics::kernels {

namespace {

static_assert(kSpringLanes == kPack);

struct Stretched {
  Lanes along[3];  // from the first end to the second
  Lanes length;
};

OMENTUM_LANES_INLINE void stretch(const SpringPack& pack, const double* u, Stretched& s) {
  for (int a = 0; a < 3; ++a)
    s.along[a] = lanes_at(pack.rest[a]) + (gather(u + a, pack.first[1]) - gather(u + a, pack.first[0]));
  s.length = square_root(s.along[0] * s.along[0] + s.along[1] * s.along[1] + s.along[2] * s.along[2]);
}

}  // namespace

void add_spring_forces(const SpringPack* packs, int count, const double* u, double* f) noexcept {
  for (int i = 0; i < count; ++i) {
    const SpringPack& pack = packs[i];
    Stretched s;
    stretch(pack, u, s);
    // ends in one place have no direction
    const LaneMask pulls = (lanes_at(pack.stiffness) > 0) & (s.length > 0);
    const Lanes tension =
        pulls ? lanes_at(pack.stiffness) * (s.length - lanes_at(pack.length)) / s.length : Lanes{};
    alignas(64) double force[3][kPack];
    for (int a = 0; a < 3; ++a) lanes_at(force[a]) = pulls ? tension * s.along[a] : Lanes{};
    // lane after lane: two of them may share a node
    for (int l = 0; l < kPack; ++l) {
      double* from = f + pack.first[0][l];
      double* to = f + pack.first[1][l];
      for (int a = 0; a < 3; ++a) {
        from[a] += force[a][l];
        to[a] -= force[a][l];
      }
    }
  }
}

double spring_energy(const SpringPack* packs, int count, const double* u) noexcept {
  Lanes sum{};
  for (int i = 0; i < count; ++i) {
    const Lanes stiffness = lanes_at(packs[i].stiffness);
    Stretched s;
    stretch(packs[i], u, s);
    const Lanes elongation = s.length - lanes_at(packs[i].length);
    sum += stiffness > 0 ? 0.5 * stiffness * elongation * elongation : Lanes{};
  }
  double total = 0;
  for (int l = 0; l < kPack; ++l) total += sum[l];
  return total;
}

}  // namespace omentum::physics::kernels
