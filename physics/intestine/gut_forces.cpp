#include "physics/intestine/gut_forces.h"

#include <algorithm>

namespace omentum::physics {

namespace {

// Behind these come springs between held masses of the vessel's row, which are none.
std::size_t spring_count(const geometry::GutLayout& layout) {
  return static_cast<std::size_t>((layout.rows - 1) * layout.columns - 1);
}

kernels::SpringRun run_of(const GutSprings& springs, const GutSpringFamily& family) {
  return {spring_count(springs.layout()), static_cast<std::size_t>(family.offset),
          family.stiffness_n_m.data(), family.rest_m.data()};
}

// So many masses at a time all springs of: what one direction leaves in the cache the next one finds there.
constexpr std::size_t kBlock = 512;

kernels::SpringRun part_of(const kernels::SpringRun& run, std::size_t first) {
  return {std::min(kBlock, run.count - first), run.offset, run.k + first, run.rest + first};
}

kernels::Planes behind(const kernels::Planes& planes, std::size_t first) {
  return {planes.x + first, planes.y + first, planes.z + first};
}

kernels::BendRun run_of(const GutBends& bends) {
  return {bends.rest_m.size() - 2, bends.stiffness_n_m.data() + 1, bends.rest_m.data() + 1};
}

}  // namespace

GutForces::GutForces(const GutSprings& springs)
    : tau_s_(springs.damping_s()), bends_(run_of(springs.bends())) {
  for (const GutSpringFamily& family : springs.families()) springs_.emplace_back(run_of(springs, family));
}

double GutForces::measure(GutPlanes& x) noexcept {
  double sum = 0;
  each([&](auto& loop) { sum += kernels::measure(loop.run, x.planes(), loop.length.data()); });
  return 0.5 * sum;
}

void GutForces::begin_step(double step_s) noexcept {
  damping_ = tau_s_ / step_s;
  each([&](auto& loop) {
    kernels::set_pull(loop.run.count, loop.run.k, loop.run.rest, damping_, loop.length.data(),
                      loop.pull.data());
  });
}

void GutForces::add_implicit(GutPlanes& x, GutPlanes& f) const noexcept {
  const double stiffer = 1 + damping_;
  for (std::size_t first = 0; first < springs_[0].run.count; first += kBlock) {
    for (const auto& loop : springs_)
      kernels::add_forces(part_of(loop.run, first), stiffer, &loop.pull[first], behind(x.planes(), first),
                          behind(f.planes(), first));
  }
  kernels::add_forces(bends_.run, stiffer, bends_.pull.data(), x.planes(), f.planes());
}

void GutForces::add_explicit(GutPlanes& x, GutPlanes& v, GutPlanes& f) const noexcept {
  each([&](const auto& loop) {
    kernels::add_damped_forces(loop.run, tau_s_, x.planes(), v.planes(), f.planes());
  });
}

}  // namespace omentum::physics
