#include "physics/hybrid/hybrid_step.h"

#include "physics/dynamics/implicit_step.h"
#include "tests/physics/hybrid/hybrid_beam.h"
#include "tests/support/heap_count.h"

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::TetId;
using test::HybridBeam;
using test::Values;

constexpr double kStep_s = 0.01;
// Tensors are stored in float, and used several times over.
constexpr double kFloat = 2e-5;

class HybridStepTest : public testing::Test {
 protected:
  HybridStepTest() {
    beam_.inertia.mass_damping_per_s = 2;
    beam_.inertia.stiffness_damping_s = 0.01;
  }

  // A kilogram of the precomputed part's own nodes weighs next to nothing.
  ImplicitStep whole() const {
    Inertia inertia = beam_.inertia;
    for (std::size_t n = 0; n < inertia.mass.size(); ++n)
      if (!beam_.split.dynamic.own_node[n].valid()) inertia.mass[n] *= 1e-9;
    return {beam_.mesh, beam_.material, inertia, {.step_s = kStep_s}};
  }
  HybridStep hybrid() const { return {beam_.body(), kStep_s, 24}; }

  // A press on each part's upper side, beside the weight.
  Values pressed() const {
    Values f = beam_.weights;
    for (const Vec3& place : {Vec3(0.03, 0.015, 0.03), Vec3(0.105, 0.015, 0.03)})
      Vec3::Map(&f[3 * static_cast<std::size_t>(beam_.nearest(place))]) += Vec3(0.01, 0.02, -0.05);
    return f;
  }
  double energy(HybridStep& hybrid, const BodyState& state) const {
    return energy(hybrid, state, beam_.inertia.mass);
  }
  double energy(HybridStep& hybrid, const BodyState& state, std::span<const double> mass) const {
    double kinetic_j = 0;
    for (const NodeId n : beam_.split.dynamic.node)
      kinetic_j += mass[static_cast<std::size_t>(n)] * Vec3(state.v.data() + 3 * n).squaredNorm() / 2;
    return hybrid.elastic_energy(state.u) + kinetic_j;
  }
  std::vector<TetId> some_dynamic() const {
    const std::vector<TetId>& all = beam_.split.dynamic.tetrahedron;
    return {all[3], all[40], all[41], all[90]};
  }

  HybridBeam beam_;
};

TEST_F(HybridStepTest, ItIsTheWholeTissuesStepButForThePrecomputedPartsMass) {
  HybridStep hybrid = this->hybrid();
  ImplicitStep whole = this->whole();
  BodyState a = state_at_rest(beam_.mesh.positions.size()), b = a;
  const Values pressed = this->pressed();
  for (int i = 0; i < 40; ++i) {
    if (i == 20) {
      ASSERT_TRUE(hybrid.remove(some_dynamic()));
      ASSERT_TRUE(whole.remove(some_dynamic()));
    }
    const Values& external = i < 10 ? beam_.weights : pressed;
    ASSERT_TRUE(hybrid.step(a, external));
    ASSERT_TRUE(whole.step(b, external));
    ASSERT_LE(beam_.difference(a.u, b.u), kFloat) << i;
  }
  EXPECT_LE(beam_.difference(a.v, b.v), 1e-3);
}

TEST_F(HybridStepTest, ItRestsWhereTheDirectSolveIs) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  for (int i = 0; i < 1500; ++i) ASSERT_TRUE(hybrid.step(state, pressed));
  std::vector<Vec3> loads;
  for (std::size_t n = 0; n < beam_.mesh.positions.size(); ++n) loads.emplace_back(pressed.data() + 3 * n);
  const StaticSolution exact =
      direct_solve(assemble_stiffness(beam_.mesh, beam_.material), beam_.inertia.fixed, {}, loads);
  Values expected;
  for (const Vec3& u : exact.displacements) expected.insert(expected.end(), u.begin(), u.end());
  EXPECT_LE(beam_.difference(state.u, expected), 1e-6);
}

TEST_F(HybridStepTest, EnergyNeverGrowsByMoreThanTheWorkPressesAndCutsIncluded) {
  beam_.inertia.mass_damping_per_s = beam_.inertia.stiffness_damping_s = 0;
  for (const double dt : {1e-3, 1e-2, 0.2}) {
    HybridStep hybrid(beam_.body(), dt, 24);
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    for (std::size_t c = 0; c < state.v.size(); ++c)
      if (beam_.split.dynamic.own_node[c / 3].valid()) state.v[c] = test::random_values(1, 1, 7 + c)[0];
    const Values pressed = this->pressed();
    CarriedMass carried(beam_.mesh, beam_.material, beam_.inertia.mass);
    const double scale = energy(hybrid, state);
    for (std::size_t i = 0; i < 200; ++i) {
      if (i % 20 == 10) {
        const std::span<const TetId> gone(&beam_.split.dynamic.tetrahedron[i / 3], 1);
        ASSERT_TRUE(hybrid.remove(gone)) << "dt " << dt << ", step " << i;
        carried.remove(gone);
      }
      // presses come and go at once
      const Values& external = i / 30 % 2 == 0 ? beam_.weights : pressed;
      const double before = energy(hybrid, state, carried.kg());
      ASSERT_TRUE(hybrid.step(state, external));
      const double work = hybrid.work(external, state.v);
      ASSERT_LE(energy(hybrid, state, carried.kg()), before + work + 1e-6 * scale)
          << "dt " << dt << ", step " << i;
    }
  }
}

TEST_F(HybridStepTest, WhereNothingActsEnergyOnlyFalls) {
  beam_ = HybridBeam(Vec3::Zero());
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values nothing(beam_.components());
  Values pressed = nothing;
  pressed[3 * static_cast<std::size_t>(beam_.nearest({0.03, 0.015, 0.03})) + 2] = -0.05;
  ASSERT_TRUE(hybrid.step(state, pressed));
  const double pressed_j = energy(hybrid, state);
  double before = pressed_j;
  for (int i = 0; i < 3000; ++i) {
    ASSERT_TRUE(hybrid.step(state, nothing));
    const double after = energy(hybrid, state);
    ASSERT_LE(after, before * (1 + 1e-9) + 1e-30) << i;
    before = after;
  }
  EXPECT_LE(before, 1e-3 * pressed_j);
}

// On both sides of the border and on it.
TEST_F(HybridStepTest, ThePatchOnTheBorderYieldsAsTheWholeTissueDoes) {
  HybridStep hybrid = this->hybrid();
  ImplicitStep whole = this->whole();
  ASSERT_TRUE(hybrid.remove(some_dynamic()) && whole.remove(some_dynamic()));
  std::vector<NodeId> nodes;
  for (const double x : {0.045, 0.06, 0.075})
    for (const double y : {0.0, 0.015, 0.03}) nodes.push_back(beam_.nearest({x, y, 0.03}));
  const std::size_t width = 3 * nodes.size();
  std::vector<float> a(width * width), b(a.size());
  hybrid.compliance(nodes, a);
  whole.compliance(nodes, b);
  const float largest = *std::ranges::max_element(b);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 2e-5F * largest) << i;
  // and as it does when it is asked for a force
  for (std::size_t p = 0; p < width; ++p) {
    Values force(beam_.components()), yield(force.size());
    force[3 * static_cast<std::size_t>(nodes[p / 3]) + p % 3] = 1;
    hybrid.yield_to(force, yield);
    for (std::size_t q = 0; q < width; ++q)
      ASSERT_NEAR(yield[3 * static_cast<std::size_t>(nodes[q / 3]) + q % 3], a[q * width + p],
                  2e-5 * static_cast<double>(largest));
  }
}

TEST_F(HybridStepTest, ItForeseesTheNextStep) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  Values foreseen(state.u.size());
  for (int i = 0; i < 5; ++i) {
    hybrid.foresee(state, pressed, foreseen);
    ASSERT_TRUE(hybrid.step(state, pressed));
    ASSERT_LE(beam_.difference(foreseen, state.u), 1e-6);
  }
}

TEST_F(HybridStepTest, WhatWasCutComesBack) {
  HybridStep hybrid = this->hybrid();
  Values force(beam_.components()), before(force.size()), cut(force.size()), after(force.size());
  force[3 * static_cast<std::size_t>(beam_.nearest({0.12, 0.015, 0.03})) + 2] = 1;
  hybrid.yield_to(force, before);
  ASSERT_TRUE(hybrid.remove(some_dynamic()));
  hybrid.yield_to(force, cut);
  hybrid.restore();
  hybrid.yield_to(force, after);
  EXPECT_NE(before, cut);
  EXPECT_EQ(before, after);
}

TEST_F(HybridStepTest, NothingIsAllocated) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  Values u(state.u.size());
  const std::vector<TetId> some = some_dynamic();
  const std::vector<NodeId> nodes{beam_.nearest({0.045, 0.015, 0.03}), beam_.nearest({0.075, 0.015, 0.03})};
  std::vector<float> block(36);
  const std::size_t before = test::heap_allocations();
  bool sound = hybrid.step(state, pressed) && hybrid.remove(some);
  hybrid.foresee(state, pressed, u);
  hybrid.yield_to(pressed, u);
  hybrid.compliance(nodes, block);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(sound);
}

}  // namespace
}  // namespace omentum::physics
