#include "physics/intestine/gut_system.h"

#include "geometry/gut_anatomy.h"
#include "tests/physics/intestine/gut_shapes.h"
#include "tests/support/effort.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace omentum::physics {
namespace {

using geometry::GutLayout;
using geometry::MassId;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double kInf = std::numeric_limits<double>::infinity();

GutObstacle floor_at(double z) {
  return {.kind = GutObstacle::Kind::kHalfSpace, .centre = Vec3(0, 0, z)};
}

// A gut that falls on a floor and lies on itself.
class FallenGut : public testing::Test {
 protected:
  static GutSystem fresh(const GutStepSettings& step = {}) {
    return GutSystem(test::curtain({4, 60}, 1.5), {.mesentery_stretch_n_m = 300}, {}, step);
  }
  void step(GutSystem& gut, int steps) const {
    const std::array floors{floor_at(-0.17)};
    for (int i = 0; i < steps; ++i) gut.step({.obstacles = floors, .spheres = spheres_});
  }
  std::vector<MovingSphere> spheres_;
};

TEST_F(FallenGut, TheSameRunIsTheSameBitForBit) {
  GutSystem one = fresh(), other = fresh();
  step(one, 300);
  step(other, 300);
  EXPECT_EQ(one.state().x, other.state().x);
  EXPECT_EQ(one.state().v, other.state().v);
}

TEST_F(FallenGut, AResetGoesBackToTheStartAndRunsAsThen) {
  GutSystem gut = fresh();
  step(gut, 100);
  const Points first = gut.state().x;
  gut.reset();
  EXPECT_EQ(gut.state().x, gut.shape().positions);
  step(gut, 100);
  EXPECT_EQ(gut.state().x, first);
}

// Of a search by chance too: what it follows would take many steps to be found again.
TEST_F(FallenGut, WhatTakesItUpGoesOnAsItDoes) {
  for (const GutPairMethod method : {GutPairMethod::kComplete, GutPairMethod::kStochastic}) {
    const auto make = [&] {
      return GutSystem(test::curtain({4, 60}, 1.5), {.mesentery_stretch_n_m = 300}, {.method = method}, {});
    };
    GutSystem gut = make(), other = make();
    step(gut, 200);
    other.take_up(gut);
    step(gut, 5);
    step(other, 5);
    ASSERT_GT(gut.report().collisions.contacts, 20);
    EXPECT_EQ(other.report().collisions.contacts, gut.report().collisions.contacts);
    double apart_m = 0;
    for (std::size_t m = 0; m < gut.state().x.size(); ++m)
      apart_m = std::max(apart_m, (gut.state().x[m] - other.state().x[m]).norm());
    EXPECT_LT(apart_m, 1e-9);
    // what searches for every pair goes on with its list: not even an order of sums is another
    if (method == GutPairMethod::kComplete) {
      EXPECT_EQ(other.state().x, gut.state().x);
      EXPECT_EQ(other.state().v, gut.state().v);
    }
  }
}

TEST_F(FallenGut, StepsAllocateNothing) {
  for (const GutMethod method : {GutMethod::kProjective, GutMethod::kExplicit}) {
    GutSystem gut = fresh({.method = method, .step_s = method == GutMethod::kExplicit ? 2e-5 : 5e-3});
    spheres_ = {{.before = Vec3(0, 0.1, -0.15), .after = Vec3(0, 0.1, -0.15), .radius_m = 0.01}};
    Points forces(gut.state().x.size(), Vec3::Zero()), yield(forces.size());
    const std::vector<MassId> masses{MassId(20), MassId(21)};
    std::vector<double> block(4);
    const std::size_t before = test::heap_allocations();
    step(gut, 50);
    gut.step({.forces_n = forces});
    gut.compliance(masses, block);
    gut.yield_to(forces, yield);
    gut.reset();
    EXPECT_EQ(test::heap_allocations(), before);
  }
}

TEST_F(FallenGut, ReportsItsEnergies) {
  GutSystem gut = fresh();
  step(gut, 20);
  EXPECT_DOUBLE_EQ(gut.report().kinetic_j, kinetic_energy(gut.springs(), gut.state().v));
  EXPECT_NEAR(gut.report().elastic_j, gut.springs().energy(gut.state().x), 1e-12);
  EXPECT_FALSE(gut.report().diverged);
}

TEST_F(FallenGut, AForceThatIsNoNumberIsSaidAndStopsItUntilAReset) {
  GutSystem gut = fresh();
  Points forces(gut.state().x.size(), Vec3::Zero());
  forces[30].y() = std::nan("");
  gut.step({.forces_n = forces});
  EXPECT_TRUE(gut.report().diverged);
  gut.step({});
  EXPECT_TRUE(gut.report().diverged);
  gut.reset();
  EXPECT_FALSE(gut.report().diverged);
  step(gut, 10);
  EXPECT_FALSE(gut.report().diverged);
}

TEST_F(FallenGut, AForceFarBeyondAllToolsIsSaid) {
  GutSystem gut = fresh();
  Points forces(gut.state().x.size(), Vec3::Zero());
  forces[30].y() = 1e9;
  gut.step({.forces_n = forces});
  EXPECT_TRUE(gut.report().diverged);
}

// 2 g at 200 m/s have far less energy than the whole gut may.
TEST_F(FallenGut, OneMassThatGoesWildIsSaid) {
  GutSystem gut = fresh();
  Points forces(gut.state().x.size(), Vec3::Zero());
  step(gut, 1);
  EXPECT_FALSE(gut.report().diverged);
  const auto light = static_cast<std::size_t>(gut.shape().layout.mass(2, 30));
  const double yield = gut.own_yields()[light], step_s = gut.settings().step_s;
  forces[light].y() = 200 * step_s / yield;
  EXPECT_LT(gut.springs().mass()[light] * 200 * 200 / 2, 1e3);
  gut.step({.forces_n = forces});
  EXPECT_TRUE(gut.report().diverged);
}

TEST(GutSystem, ComplianceIsWhatYieldsToAUnitForce) {
  const GutSystem gut(test::curtain({4, 30}), {}, {}, {});
  const std::vector<MassId> masses{MassId(10), MassId(11), MassId(42), MassId(0)};
  std::vector<double> block(masses.size() * masses.size());
  gut.compliance(masses, block);
  Points yield(gut.state().x.size());
  for (std::size_t j = 0; j < masses.size(); ++j) {
    Points forces(yield.size(), Vec3::Zero());
    forces[static_cast<std::size_t>(masses[j])] = Vec3(0, 1, 0);
    gut.yield_to(forces, yield);
    for (std::size_t i = 0; i < masses.size(); ++i) {
      EXPECT_NEAR(block[i * masses.size() + j], yield[static_cast<std::size_t>(masses[i])].y(), 1e-18);
      EXPECT_NEAR(block[i * masses.size() + j], block[j * masses.size() + i], 1e-15);
    }
  }
  EXPECT_GT(block[0], block[1]);  // a mass moves more than its neighbour
  EXPECT_EQ(block[15], 0);        // the first one is held
}

// The promise that touch relies on: a small force moves the masses by about as much within a step.
TEST(GutSystem, AForceMovesMassesByTheirCompliance) {
  const GutStepSettings settings{.iterations = 30, .gravity_m_s2 = Vec3::Zero()};
  GutSystem gut(test::curtain({4, 30}), {}, {}, settings);
  Points forces(gut.state().x.size(), Vec3::Zero());
  forces[15] = Vec3(1e-3, 0, 0);
  Points yield(forces.size());
  gut.yield_to(forces, yield);
  gut.step({.forces_n = forces});
  const double moved = (gut.state().x[15] - gut.shape().positions[15]).x();
  EXPECT_NEAR(moved, yield[15].x(), 0.5 * yield[15].x());
}

std::string refusal(const GutStepSettings& settings) {
  try {
    GutSystem(test::curtain({4, 20}), {}, {}, settings);
  } catch (const std::invalid_argument& wrong) {
    return wrong.what();
  }
  return "";
}

TEST(GutSystem, RefusesStepsThatCannotBe) {
  EXPECT_NE(refusal({.step_s = 0}).find("step_s"), std::string::npos);
  EXPECT_NE(refusal({.step_s = kInf}).find("step_s"), std::string::npos);
  EXPECT_NE(refusal({.iterations = 0}).find("iterations"), std::string::npos);
  EXPECT_NE(refusal({.gravity_m_s2 = Vec3(0, 0, kInf)}).find("gravity"), std::string::npos);
  EXPECT_NE(refusal({.method = GutMethod::kExplicit, .step_s = 0.01}).find("step_s"), std::string::npos);
}

// The mass of the axis that lies on top.
std::size_t highest(const GutSystem& gut) {
  const auto axis = std::span(gut.state().x).first(static_cast<std::size_t>(gut.shape().layout.columns));
  const auto lower = [](const Vec3& one, const Vec3& other) { return one.z() < other.z(); };
  return static_cast<std::size_t>(std::ranges::max_element(axis, lower) - axis.begin());
}

// How far the topmost loop of a gut on a plane comes up under a force, m.
double lifted_m(double force_n) {
  GutSystem gut(geometry::make_gut({}), {}, {}, {});
  const std::array plane{floor_at(-0.1)};
  Points forces(gut.state().x.size(), Vec3::Zero());
  for (int i = 0; i < 600; ++i) gut.step({.obstacles = plane});
  const std::size_t loop = highest(gut);
  const double start_m = gut.state().x[loop].z();
  forces[loop].z() = force_n;
  for (int i = 0; i < 800; ++i) gut.step({.forces_n = forces, .obstacles = plane});
  return gut.state().x[loop].z() - start_m;
}

// docs/intestine.md has the table: from lifting weight to stretching what holds it.
TEST(GutSystem, AHandThatPullsALoopFeelsTheMesenteryTighten) {
  double last_m = lifted_m(2), last_n = 2, last_stiffness_n_m = 0;
  for (const double force_n : {4.0, 6.0, 8.0}) {
    const double way_m = lifted_m(force_n);
    const double stiffness_n_m = (force_n - last_n) / (way_m - last_m);
    EXPECT_GT(way_m, last_m) << force_n << " N";
    EXPECT_GT(stiffness_n_m, last_stiffness_n_m) << force_n << " N";
    last_m = way_m;
    last_n = force_n;
    last_stiffness_n_m = stiffness_n_m;
  }
}

double mean_speed_m_s(const GutState& state) {
  double sum = 0;
  for (const Vec3& v : state.v) sum += v.norm();
  return sum / static_cast<double>(state.v.size());
}

TEST(GutSystem, AFoldedGutComesToRestOnAPlane) {
  GutSystem gut(geometry::make_gut({}), {}, {}, {.step_s = 2.5e-3, .iterations = 5});
  const std::array plane{floor_at(-0.08)};
  double last_second_m_s = 0;
  for (int i = 0; i < 4000; ++i) {
    gut.step({.obstacles = plane});
    if (i >= 3600) last_second_m_s += mean_speed_m_s(gut.state()) / 400;
  }
  EXPECT_FALSE(gut.report().diverged);
  EXPECT_LT(last_second_m_s, 1e-3);
  EXPECT_LT(gut.report().collisions.deepest_m, 0.05 * gut.shape().tube_radius_m);
}

TEST(GutSystem, ProbesWithoutSenseGiveItNoEnergyToKeep) {
  GutSystem gut(geometry::make_gut({}), {}, {}, {});
  const std::array plane{floor_at(-0.03)};
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> place(-0.2, 0.2);
  Vec3 at(0, 0, 0.5);
  double most_j = 0;
  for (int motion = 0; motion < test::tried(1000); ++motion) {
    const Vec3 to(place(generator), place(generator), std::abs(place(generator)));
    const std::array probe{MovingSphere{.before = at, .after = to, .radius_m = 0.01}};
    gut.step({.obstacles = plane, .spheres = probe});
    at = gut.outcomes()[0].reached;
    most_j = std::max(most_j, gut.report().kinetic_j + gut.report().elastic_j);
  }
  EXPECT_FALSE(gut.report().diverged);
  EXPECT_LT(most_j, 50);  // some ten times what its weight gives it
  for (int i = 0; i < 400; ++i) gut.step({.obstacles = plane});
  EXPECT_LT(gut.report().kinetic_j, 0.05);
}

}  // namespace
}  // namespace omentum::physics
