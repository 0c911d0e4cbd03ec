#include "organ_tools/intestine_soak/soak_run.h"

#include "organ_tools/intestine_recall/pulling_hand.h"
#include "physics/intestine/gut_crossings.h"
#include "physics/intestine/gut_system.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace omentum::intestine_soak {
namespace {

using geometry::MassId;
using geometry::Vec3;
using physics::Way;

constexpr double kPlane_m = -0.12;  // just clear of the gut at its start
constexpr double kProbe_m = 0.01, kHand_n = 20;
constexpr double kViolent_m_s = 6, kViolentStep_s = 5e-3;
constexpr double kGrowth = 1.5;
constexpr std::int64_t kSettling = 8000;  // steps until a gut that falls has met all that it will

// Where a probe that stirs is: on a circle through the folds, up and down, at up to 0.1 m/s.
Vec3 stirring(double time_s) {
  const double turn = 0.5 * time_s;
  return {0.12 * std::cos(turn), 0.12 * std::sin(turn), 0.05 + 0.08 * std::sin(0.3 * turn)};
}

// Of a ball's centre with the mesentery; the axis is its edge and no narrower.
std::int64_t probe_crossings(const physics::GutParts& parts, std::span<const Vec3> from,
                             std::span<const Vec3> to, const Way& probe) {
  std::int64_t crossings = 0;
  for (std::int32_t part = parts.layout.segment_count(); part < parts.count(); ++part) {
    const auto& m = parts.masses[static_cast<std::size_t>(part)];
    const physics::Ball ball = parts.ball_around(part, from);
    const double near_m = ball.radius_m + 2 * physics::GutParts::kFinest * parts.reach.tube_m;
    if ((ball.centre - probe.from).norm() > near_m) continue;
    crossings +=
        point_meets_triangle(probe, {from[m[0]], to[m[0]]}, {from[m[1]], to[m[1]]}, {from[m[2]], to[m[2]]})
            ? 1
            : 0;
  }
  return crossings;
}

class LongRunner {
 public:
  LongRunner(const geometry::GutShape& shape, const LongRun& run)
      : run_(run),
        hand_(shape, run.seed),
        system_(shape, {}, {}, {.step_s = run.step_s}),
        parts_(shape),
        plane_{.centre = Vec3(0, 0, kPlane_m)},
        probe_{.before = stirring(0), .radius_m = kProbe_m, .most_force_n = kHand_n} {}

  SoakReport run() {
    const auto steps = static_cast<std::int64_t>(std::llround(run_.seconds / run_.step_s));
    while (report_.steps < steps && !report_.diverged) step(report_.steps < std::max(kSettling, steps / 2));
    return report_;
  }

 private:
  void step(bool is_early) {
    const std::vector<Vec3> before = system_.state().x;
    probe_.after = stirring(static_cast<double>(++report_.steps) * run_.step_s);
    system_.step({.forces_n = hand_.pull(before, run_.step_s),
                  .obstacles = std::span(&plane_, 1),
                  .spheres = std::span(&probe_, 1)});
    const std::vector<Vec3>& after = system_.state().x;
    const Vec3 reached = system_.outcomes()[0].reached;
    report_.crossings += count_crossings(parts_, before, after, report_.pairs);
    report_.crossings += probe_crossings(parts_, before, after, {probe_.before, reached});
    probe_.before = reached;
    note(is_early);
  }

  void note(bool is_early) {
    const physics::GutReport& now = system_.report();
    report_.bound_acted = now.collisions.bound_acted;
    report_.left_out = now.collisions.left_out;
    report_.most_pairs = std::max(report_.most_pairs, now.collisions.pairs_tracked);
    if (is_early) report_.early_pairs = report_.most_pairs;
    report_.deepest_m = std::max(report_.deepest_m, now.collisions.deepest_m);
    report_.most_j = std::max(report_.most_j, now.kinetic_j + now.elastic_j);
    report_.diverged = now.diverged;
  }

  LongRun run_;
  intestine_recall::PullingHand hand_;
  physics::GutSystem system_;
  physics::GutParts parts_;
  physics::GutObstacle plane_;
  physics::MovingSphere probe_;
  SoakReport report_;
};

// A vector with components from -size to size, the same on every machine.
Vec3 any_direction(std::mt19937_64& random, double size) {
  const auto number = [&] { return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1); };
  const double x = number(), y = number(), z = number();
  return {x, y, z};
}

}  // namespace

bool SoakReport::holds() const {
  return crossings == 0 && !diverged &&
         static_cast<double>(most_pairs) <=
             kGrowth * static_cast<double>(std::max<std::int64_t>(early_pairs, 1));
}

SoakReport run_long(const geometry::GutShape& gut, const LongRun& run) {
  return LongRunner(gut, run).run();
}

SoakReport run_violently(const geometry::GutShape& gut, double pair_steps, std::uint64_t seed) {
  const std::vector<double> masses_kg(gut.positions.size(), 0.01);
  physics::GutCollisions collisions(gut, masses_kg, kViolentStep_s);
  physics::GutState state{gut.positions, std::vector<Vec3>(gut.positions.size(), Vec3::Zero())};
  std::mt19937_64 random(seed);
  SoakReport report;
  while (static_cast<double>(report.pairs) < pair_steps) {
    const std::vector<Vec3> before = state.x;
    for (std::size_t m = 0; m < state.x.size(); ++m) {
      if (gut.layout.is_held(MassId(m))) continue;
      state.v[m] = 0.5 * state.v[m] + any_direction(random, kViolent_m_s);
      state.x[m] += kViolentStep_s * state.v[m];
    }
    collisions.resolve(before, state, {}, {});
    report.crossings += count_crossings(collisions.parts(), before, state.x, report.pairs);
    report.most_pairs = std::max(report.most_pairs, collisions.report().pairs_tracked);
    if (report.steps < kSettling || 2 * static_cast<double>(report.pairs) < pair_steps)
      report.early_pairs = report.most_pairs;
    ++report.steps;
  }
  report.bound_acted = collisions.report().bound_acted;
  report.left_out = collisions.report().left_out;
  return report;
}

}  // namespace omentum::intestine_soak
