#include "physics/intestine/gut_explicit.h"
#include "physics/intestine/gut_projective.h"

#include "tests/physics/intestine/gut_shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace omentum::physics {
namespace {

using geometry::GutLayout;
using geometry::GutShape;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr int kIterations = 6;

Points weight(const GutSprings& springs) {
  Points f;
  for (const double m : springs.mass()) f.push_back(m * Vec3(0, 0, -9.81));
  return f;
}

Points nothing(const GutSprings& springs) {
  return Points(springs.mass().size(), Vec3::Zero());
}

GutState at_rest(const Points& x) {
  return {x, Points(x.size(), Vec3::Zero())};
}

double largest_way(const Points& from, const Points& to) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); ++i) most = std::max(most, (to[i] - from[i]).norm());
  return most;
}

double energy(const GutSprings& springs, const GutState& state) {
  return springs.energy(state.x) + kinetic_energy(springs, state.v);
}

void run_projective(const GutSprings& springs, double step_s, double until_s, GutState& state,
                    int iterations = kIterations) {
  const GutBand band(springs, step_s);
  GutProjective step(springs, band, step_s, iterations);
  const Points f = weight(springs);
  for (double t = 0; t < until_s; t += step_s) step.step(f, state);
}

void run_explicit(const GutSprings& springs, double until_s, GutState& state) {
  const double step_s = stable_step_s(springs);
  GutExplicit step(springs, step_s);
  const Points f = weight(springs);
  for (double t = 0; t < until_s; t += step_s) step.step(f, state);
}

GutState hung(const GutShape& shape, const GutSprings& springs) {
  GutState state = at_rest(shape.positions);
  run_projective(springs, 5e-3, 10, state, 20);
  return state;
}

TEST(GutExplicit, AStepAboveTheStableOneIsRefusedAndTheStableOneTold) {
  const GutSprings springs(test::curtain({}), {});
  const double stable_s = stable_step_s(springs);
  EXPECT_NO_THROW(GutExplicit(springs, stable_s));
  try {
    GutExplicit(springs, 1.01 * stable_s);
    FAIL();
  } catch (const std::invalid_argument& wrong) {
    EXPECT_NE(std::string(wrong.what()).find(std::to_string(stable_s)), std::string::npos) << wrong.what();
  }
}

// Without any damping there is nothing that could hide growth; three times the step shows that the bound is
// near.
TEST(GutExplicit, AtTheStableStepEnergyStaysAndAboveItGrows) {
  const GutShape shape = test::curtain({4, 20});
  const GutSprings springs(
      shape, {.spring_damping_s = 0, .calming_time_s = std::numeric_limits<double>::infinity()});
  const Points none = nothing(springs);
  GutState state{shape.positions, test::deviates(shape.layout, 0.01)};
  const double start_j = energy(springs, state);
  GutExplicit step(springs, 0.99 * stable_step_s(springs));
  for (int i = 0; i < 20'000; ++i) step.step(none, state);
  EXPECT_LT(energy(springs, state), 2 * start_j);
  EXPECT_GT(energy(springs, state), 0.5 * start_j);
}

TEST(GutProjective, EnergyNeverGrowsWithoutWork) {
  for (const double step_s : {1e-3, 5e-3, 16e-3}) {
    for (const int iterations : {2, 4, 10}) {
      const GutShape shape = test::curtain({4, 40});
      const GutSprings springs(shape, {});
      const GutBand band(springs, step_s);
      GutProjective step(springs, band, step_s, iterations);
      GutState state{test::shaken(shape, 0.02), test::deviates(shape.layout, 3)};
      const Points none = nothing(springs);
      double last_j = energy(springs, state);
      for (int i = 0; i < 400; ++i) {
        step.step(none, state);
        const double now_j = energy(springs, state);
        EXPECT_LE(now_j, last_j * (1 + 1e-9))
            << "step " << i << " of " << step_s << " s, " << iterations << " iterations";
        last_j = now_j;
      }
    }
  }
}

TEST(GutProjective, RestsWhereTheExplicitStepRests) {
  const GutShape shape = test::curtain({4, 40}, 1.5);
  const GutSprings springs(shape, {});
  GutState projective = hung(shape, springs);
  const double sag_m = largest_way(shape.positions, projective.x);
  GutState explicit_one = projective;
  run_explicit(springs, 1, explicit_one);
  EXPECT_GT(sag_m, 1e-3);
  EXPECT_LT(largest_way(projective.x, explicit_one.x), 1e-4 * sag_m);
}

TEST(GutProjective, RestDependsNeitherOnTheStepNorOnTheIterations) {
  const GutShape shape = test::curtain({4, 40}, 1.5);
  const GutSprings springs(shape, {});
  const GutState rest = hung(shape, springs);
  const double sag_m = largest_way(shape.positions, rest.x);
  for (const double step_s : {1e-3, 5e-3, 16e-3}) {
    for (const int iterations : {1, 10}) {
      GutState state = rest;
      run_projective(springs, step_s, 4, state, iterations);
      EXPECT_LT(largest_way(rest.x, state.x), 1e-4 * sag_m)
          << step_s << " s, " << iterations << " iterations";
    }
  }
}

double sag(const GutLayout& layout, const GutMaterial& material) {
  const GutShape shape = test::curtain(layout, 1.5);
  const GutSprings springs(shape, material);
  const GutState state = hung(shape, springs);
  return largest_way(shape.positions, state.x);
}

TEST(GutSprings, AFinerGutHangsAsTheCoarseOneDoes) {
  const double coarse_m = sag({4, 40}, {}), fine_m = sag({4, 400}, {});
  EXPECT_NEAR(coarse_m, fine_m, 0.05 * fine_m);
}

// A mesentery that holds hardly anything leaves stretching and bending of the gut alone.
TEST(GutSprings, AFinerGutWithoutSupportHangsAsTheCoarseOneDoes) {
  const GutMaterial loose{.mesentery_mass_kg_m2 = 0.02, .mesentery_stretch_n_m = 1};
  const double coarse_m = sag({4, 40}, loose), fine_m = sag({4, 400}, loose);
  EXPECT_GT(coarse_m, 0.1);
  EXPECT_NEAR(coarse_m, fine_m, 0.05 * fine_m);
}

TEST(GutProjective, CalmsDownWithinTenSecondsOfARelease) {
  const GutShape shape = test::curtain({4, 100}, 1.5);
  const GutSprings springs(shape, {});
  GutState state{test::shaken(shape, 0.01), test::deviates(shape.layout, 1)};
  run_projective(springs, 5e-3, 10, state);
  double sum = 0;
  for (const Vec3& v : state.v) sum += v.norm();
  EXPECT_LT(sum / static_cast<double>(state.v.size()), 1e-3);
}

}  // namespace
}  // namespace omentum::physics
