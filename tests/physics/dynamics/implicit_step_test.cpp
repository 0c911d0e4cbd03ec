#include "physics/dynamics/implicit_step.h"

#include "physics/direct_solve.h"
#include "physics/dynamics/tensor_mass.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/physics/dynamics/kept_factor_fixtures.h"
#include "tests/support/heap_count.h"

namespace omentum::physics {
namespace {

using geometry::TetId;
using test::HeldBody;
using test::Values;

const Vec3 kGravity(0.5, -9, 3);

// What float cannot hold any more, squared: a body that has swung out.
constexpr double kNothing_j = 1e-60;

Values weight_of(const Inertia& inertia) {
  Values f(3 * inertia.mass.size());
  for (std::size_t c = 0; c < f.size(); ++c) f[c] = inertia.mass[c / 3] * kGravity[static_cast<int>(c % 3)];
  return f;
}

// Velocities of about 1 m/s, none where the body is held.
BodyState struck(const HeldBody& body) {
  BodyState state = state_at_rest(body.mesh.positions.size());
  state.v = test::random_values(body.components(), 1, 21);
  for (std::size_t c = 0; c < state.v.size(); ++c) {
    if (body.held(c)) state.v[c] = 0;
  }
  return state;
}

double energy(ImplicitStep& stepper, const CarriedMass& carried, const BodyState& state) {
  return stepper.elastic_energy(state.u) + kinetic_energy(carried.kg(), state.v);
}

TEST(ImplicitStepTest, RestEqualsTheDirectSolveAlsoOfACutBody) {
  HeldBody body = test::held_box();
  body.inertia.mass_damping_per_s = 2;
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.1});
  std::vector<TetId> removed = body.any_order();
  removed.resize(5);
  ASSERT_TRUE(stepper.remove(removed));
  BodyState state = state_at_rest(body.mesh.positions.size());
  const Values weight = weight_of(body.inertia);
  for (int i = 0; i < 600; ++i) ASSERT_TRUE(stepper.step(state, weight));

  std::vector<Vec3> loads;
  for (const double mass : body.inertia.mass) loads.push_back(mass * kGravity);
  const StaticSolution exact = direct_solve(body.stiffness_without(removed), body.inertia.fixed, {}, loads);
  double size = 0, off = 0;
  for (std::size_t n = 0; n < loads.size(); ++n) {
    size = std::max(size, exact.displacements[n].norm());
    off = std::max(
        off, (Vec3(state.u[3 * n], state.u[3 * n + 1], state.u[3 * n + 2]) - exact.displacements[n]).norm());
  }
  EXPECT_LE(off, 1e-9 * size);
}

TEST(ImplicitStepTest, EnergyNeverGrowsByMoreThanTheWorkCutsIncluded) {
  HeldBody body = test::held_box();
  const std::vector<TetId> order = body.any_order();
  for (const double dt : {1e-4, 5e-3, 0.2}) {
    ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = dt});
    CarriedMass carried(body.mesh, test::kTissue, body.inertia.mass);
    BodyState state = struck(body);
    const Values weight = weight_of(body.inertia);
    double before = energy(stepper, carried, state);
    const double scale = before;
    for (std::size_t i = 0; i < 400; ++i) {
      if (i % 2 == 0) {
        ASSERT_TRUE(stepper.remove({&order[i], 1}));
        carried.remove({&order[i], 1});
      }
      const Values u = state.u;
      ASSERT_TRUE(stepper.step(state, weight));
      const double work = test::dot(weight, test::sum(state.u, -1, u));
      const double after = energy(stepper, carried, state);
      // a step's equation is met to what float keeps
      ASSERT_LE(after, before + work + 1e-6 * scale) << "dt " << dt << ", step " << i;
      before = after;
    }
  }
}

TEST(ImplicitStepTest, WithoutForcesEnergyOnlyFallsForAMinute) {
  const HeldBody body = test::held_box();
  const std::vector<TetId> order = body.any_order();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  CarriedMass carried(body.mesh, test::kTissue, body.inertia.mass);
  BodyState state = struck(body);
  const Values nothing(body.components());
  double before = energy(stepper, carried, state);
  for (std::size_t i = 0; i < 12000; ++i) {
    if (i % 100 == 50) {
      ASSERT_TRUE(stepper.remove({&order[i / 100], 1}));
      carried.remove({&order[i / 100], 1});
    }
    ASSERT_TRUE(stepper.step(state, nothing));
    const double after = energy(stepper, carried, state);
    ASSERT_LE(after, before * (1 + 1e-9) + kNothing_j) << i;
    before = after;
  }
}

TEST(ImplicitStepTest, AFreeBodyFallsAsItsMassDoes) {
  HeldBody body = test::held_box();
  std::ranges::fill(body.inertia.fixed, 0);
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  BodyState state = struck(body);
  const Values weight = weight_of(body.inertia);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  double mass = 0;
  const auto momentum = [&] {
    Vec3 p = Vec3::Zero();
    for (std::size_t c = 0; c < state.v.size(); ++c)
      p[static_cast<int>(c % 3)] += body.inertia.mass[c / 3] * state.v[c];
    return p;
  };
  for (const double m : body.inertia.mass) mass += m;
  before = momentum();
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(stepper.step(state, weight));
  after = momentum();
  // what the last step lacks, no more than that: errors of float do not add up
  EXPECT_LE((after - before - 5 * mass * kGravity).norm(), 1e-6 * mass * kGravity.norm());
}

TEST(ImplicitStepTest, ComplianceIsWhatAForceOfOneStepMoves) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  const std::array nodes{NodeId(100), NodeId(150)};
  std::array<float, 36> block{};
  stepper.compliance(nodes, block);
  for (std::size_t column = 0; column < 6; ++column) {
    stepper.restore();
    BodyState state = state_at_rest(body.mesh.positions.size());
    Values force(body.components());
    force[3 * nodes[column / 3] + column % 3] = 1;
    ASSERT_TRUE(stepper.step(state, force));
    for (std::size_t row = 0; row < 6; ++row)
      EXPECT_NEAR(block[6 * row + column], state.u[3 * nodes[row / 3] + row % 3], 1e-5 * block[7 * column]);
  }
}

TEST(ImplicitStepTest, TheTensorMassLawMovesItLikeItsOwnStiffness) {
  HeldBody body = test::held_box();
  body.inertia.stiffness_damping_s = 1e-3;
  body.inertia.mass_damping_per_s = 1;
  ImplicitStep own(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  ImplicitStep other(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  TensorMass law(body.mesh, test::kTissue, TensorMass::Arithmetic::kDouble);
  const std::vector<TetId> order = body.any_order();
  BodyState a = struck(body), b = a;
  const Values weight = weight_of(body.inertia);
  for (std::size_t i = 0; i < 50; ++i) {
    ASSERT_TRUE(own.remove({&order[i], 1}) && other.remove({&order[i], 1}));
    law.remove(order[i]);
    ASSERT_TRUE(own.step(a, weight) && other.step(b, law, weight));
  }
  // rounding of the two laws' forces moves a node most that is left with a thousandth of its mass
  EXPECT_LE(test::norm(test::sum(a.u, -1, b.u)), 3e-9 * test::norm(a.u));
}

TEST(ImplicitStepTest, WhatIsNotFiniteIsSaid) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  BodyState state = state_at_rest(body.mesh.positions.size());
  Values force(body.components());
  force[200] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(stepper.step(state, force));
  BodyState other = state_at_rest(body.mesh.positions.size());
  EXPECT_TRUE(stepper.step(other, Values(body.components()))) << "nothing of it is left over";
}

TEST(ImplicitStepTest, NothingIsTakenFromTheHeap) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 5e-3});
  BodyState state = struck(body);
  const Values weight = weight_of(body.inertia);
  const std::size_t before = test::heap_allocations();
  const bool finite = stepper.step(state, weight);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(finite);
}

}  // namespace
}  // namespace omentum::physics
