#include "physics/dynamics/warped_step.h"

#include "physics/dynamics/implicit_step.h"
#include "tests/physics/dynamics/law_tissue.h"
#include "tests/physics/dynamics/motions.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace omentum::physics {
namespace {

using namespace omentum::test;

constexpr double kTick_s = 0.01;  // s
constexpr double kFloat = 1e-5;   // the factor's arithmetic, with what its condition makes of it

enum class Held { kNowhere, kAtOneEnd };

class WarpedStepTest : public testing::Test {
 protected:
  const geometry::TetraMesh mesh = make_box_mesh(8, 2, 2, Vec3(8 * kEdge, 2 * kEdge, 2 * kEdge));
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(mesh.positions.size());

  Inertia inertia(Held held) const {
    Inertia body{.mass = lumped_masses(mesh, kTissue), .fixed = FixedComponents(mesh.positions.size(), 0)};
    body.mass_damping_per_s = held == Held::kAtOneEnd ? 5 : 0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (held == Held::kAtOneEnd && mesh.positions[n].x() < 0.5 * kEdge) body.fixed[n] = kPinned;
    }
    return body;
  }

  WarpedStep stepper(const Inertia& body, double tolerance = 1e-6) const {
    return {mesh, kTissue, body, Corotational(mesh, kTissue), {.step_s = kTick_s, .tolerance = tolerance}};
  }

  BodyState moving(const Vector& u, const Vector& v) const { return {values_of(u), values_of(v)}; }

  Vector weight(const Inertia& body, double acceleration) const {
    Vector force = Vector::Zero(size);
    for (std::size_t n = 0; n < body.mass.size(); ++n)
      force[3 * static_cast<Eigen::Index>(n) + 1] = -acceleration * body.mass[n];
    return force;
  }
};

TEST_F(WarpedStepTest, IsTheLinearStepWhereNothingTurns) {
  Inertia body = inertia(Held::kAtOneEnd);
  body.stiffness_damping_s = 0.003;
  WarpedStep warped = stepper(body, 1e-9);
  ImplicitStep linear(mesh, kTissue, body, {.step_s = kTick_s});
  BodyState a = state_at_rest(mesh.positions.size()), b = a;
  const Vector force = weight(body, 1e-6);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(warped.step(a, view(force)));
    ASSERT_TRUE(linear.step(b, view(force)));
  }
  EXPECT_LE(norm(sum(a.u, -1, b.u)), 10 * kFloat * norm(b.u));
}

// As what a last step lacked of a piece that then went: the factor's floats, or its square, are hardly a
// number.
TEST_F(WarpedStepTest, AnImpulseThatIsNothingIsOne) {
  WarpedStep warped = stepper(inertia(Held::kAtOneEnd));
  for (int power = -165; power < -20; power += 3) {
    BodyState state = state_at_rest(mesh.positions.size());
    const Vector push = random_vector(size, std::pow(10.0, power), 3);
    EXPECT_TRUE(warped.step(state, view(push))) << power;
    warped.restore();
  }
}

TEST_F(WarpedStepTest, ATurnedBodyNeedsNoMoreIterationsThanOneAtRest) {
  WarpedStep warped = stepper(inertia(Held::kNowhere));
  const Vector push = random_vector(size, 1e-3, 3);
  BodyState at_rest = moving(Vector::Zero(size), Vector::Zero(size));
  ASSERT_TRUE(warped.step(at_rest, view(push)));
  const int few = warped.iterations();
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Vec3(1, -1, 3).normalized()).toRotationMatrix();
  BodyState turned = moving(affine(mesh, R, Vec3::Zero()), Vector::Zero(size));
  warped.restore();
  ASSERT_TRUE(warped.step(turned, view(push)));
  EXPECT_LE(warped.iterations(), few + 1);
  EXPECT_LE(few, 3);
}

TEST_F(WarpedStepTest, MomentumIsKeptWhateverTheToleranceIs) {
  const Inertia body = inertia(Held::kNowhere);
  WarpedStep warped = stepper(body, 0.1);
  const Vector u = affine(mesh, Eigen::AngleAxisd(1, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()) +
                   random_vector(size, 0.1 * kEdge, 4);
  BodyState state = moving(u, random_vector(size, 0.1, 5));
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < body.mass.size(); ++n) sum += body.mass[n] * Vec3::Map(&state.v[3 * n]);
    return sum;
  };
  const Vec3 before = momentum();
  double mass_speed = 0;
  for (std::size_t c = 0; c < state.v.size(); ++c) mass_speed += body.mass[c / 3] * std::abs(state.v[c]);
  const Vector nothing = Vector::Zero(size);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(warped.step(state, view(nothing)));
  // what the last step's equation lacks is on its way
  EXPECT_LE((momentum() - before).norm(), 1e-3 * mass_speed);
}

TEST_F(WarpedStepTest, EnergyOfAThrownAndTwistedBodyNeverGrows) {
  const Inertia body = inertia(Held::kNowhere);
  WarpedStep warped = stepper(body, 1e-3);
  Vector twist(size), spin(size);
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& p = mesh.positions[n];
    const auto at = 3 * static_cast<Eigen::Index>(n);
    twist.segment<3>(at) = Eigen::AngleAxisd(20 * p.x(), Vec3::UnitX()) * p - p;
    spin.segment<3>(at) = Vec3(0, 3, 8).cross(p);
  }
  BodyState state = moving(twist, spin);
  const Vector nothing = Vector::Zero(size);
  double before = warped.law().energy(state.u) + kinetic_energy(body, state.v);
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(warped.step(state, view(nothing)));
    const double energy = warped.law().energy(state.u) + kinetic_energy(body, state.v);
    ASSERT_LE(energy, before * (1 + 1e-3)) << i;
    before = energy;
  }
}

// A soft bar whose end sinks by more than half of its length.
TEST_F(WarpedStepTest, BarComesToRestHangingFromItsEnd) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep warped = stepper(body, 1e-3);
  BodyState state = state_at_rest(mesh.positions.size());
  const Vector force = weight(body, 20);
  int most = 0;
  for (int i = 0; i < 1500; ++i) {
    ASSERT_TRUE(warped.step(state, view(force)));
    most = std::max(most, warped.iterations());
  }
  Vector f = force_of(warped.law(), Eigen::Map<const Vector>(state.u.data(), size)) + force;
  for (Eigen::Index c = 0; c < size; ++c) {
    if (body.fixed[static_cast<std::size_t>(c / 3)] != 0) f[c] = 0;
  }
  EXPECT_LE(f.norm(), 1e-3 * force.norm());
  EXPECT_LT(state.u[3 * 8 + 1], -4 * kEdge);
  EXPECT_LT(most, 40) << "never at the limit";
}

TEST_F(WarpedStepTest, RemovedTetrahedraAreOutAndRestoredOnesBack) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep whole = stepper(body), cut = stepper(body);
  const Vector force = weight(body, 1);
  std::vector<geometry::TetId> middle;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const geometry::NodeId n : mesh.tetrahedra[t]) centre += mesh.positions[n] / 4;
    if (std::abs(centre.x() - 2.5 * kEdge) < kEdge / 2 && centre.y() > kEdge) middle.emplace_back(t);
  }
  ASSERT_TRUE(cut.remove(middle));
  BodyState a = state_at_rest(mesh.positions.size()), b = a;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(whole.step(a, view(force)));
    ASSERT_TRUE(cut.step(b, view(force)));
  }
  EXPECT_LT(b.u[3 * 8 + 1], 1.1 * a.u[3 * 8 + 1]) << "the end hangs lower";
  cut.restore();
  BodyState c = state_at_rest(mesh.positions.size());
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(cut.step(c, view(force)));
  EXPECT_LE(norm(sum(a.u, -1, c.u)), kFloat * norm(a.u));
}

TEST_F(WarpedStepTest, ComplianceTurnsWithTheBody) {
  const Inertia body = inertia(Held::kNowhere);
  WarpedStep warped = stepper(body, 1e-9);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Vec3(1, -1, 3).normalized()).toRotationMatrix();
  const Vector u = affine(mesh, R, Vec3::Zero()), nothing = Vector::Zero(size);
  BodyState state = moving(u, nothing);
  ASSERT_TRUE(warped.step(state, view(nothing)));
  const std::vector<geometry::NodeId> nodes{geometry::NodeId(4), geometry::NodeId(30)};
  std::vector<float> block(36);
  warped.compliance(nodes, block);
  for (int j = 0; j < 3; ++j) {
    Vector push = nothing;
    push[3 * 30 + j] = 1e-5;
    BodyState pushed = moving(u, nothing);
    ASSERT_TRUE(warped.step(pushed, view(push)));
    for (int i = 0; i < 3; ++i) {
      const double moved = (pushed.u[3 * 4 + static_cast<std::size_t>(i)] - u[3 * 4 + i]) / 1e-5;
      EXPECT_NEAR(block[static_cast<std::size_t>(6 * i + 3 + j)], moved, 1e-3 * block[0]) << i << ", " << j;
    }
  }
}

TEST_F(WarpedStepTest, AForceThatIsNoNumberIsSaidAndNotKept) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep stepped = stepper(body), fresh = stepper(body);
  BodyState a = state_at_rest(mesh.positions.size()), b = a;
  Vector force = weight(body, 1);
  force[size - 2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(stepped.step(a, view(force)));
  a = b;
  force = weight(body, 1);
  ASSERT_TRUE(stepped.step(a, view(force)));
  ASSERT_TRUE(fresh.step(b, view(force)));
  EXPECT_EQ(a.u, b.u);
}

TEST_F(WarpedStepTest, ALookAheadEndsWhereTheStepDoesAndChangesNoStep) {
  Inertia body = inertia(Held::kAtOneEnd);
  body.stiffness_damping_s = 0.003;
  WarpedStep looking = stepper(body), blind = stepper(body);
  const Vector force = weight(body, 5);
  BodyState a = moving(Vector::Zero(size), Vector::Zero(size)), b = a;
  std::vector<double> u(a.u.size());
  for (int i = 0; i < 30; ++i) {
    looking.foresee(a, view(force), u);
    ASSERT_TRUE(looking.step(a, view(force)));
    ASSERT_TRUE(blind.step(b, view(force)));
    ASSERT_LE(norm(sum(u, -1, a.u)), 1e-5 * norm(a.u)) << i;
  }
  EXPECT_EQ(a.u, b.u);
}

TEST_F(WarpedStepTest, AStepAfterARemovalIsOfWhatIsLeftWhateverWasForeseen) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep looking = stepper(body), blind = stepper(body);
  const Vector force = weight(body, 5);
  BodyState a = moving(random_vector(size, 0.01 * kEdge, 6), Vector::Zero(size));
  for (std::size_t c = 0; c < a.u.size(); ++c)
    if (body.fixed[c / 3] != 0) a.u[c] = 0;
  BodyState b = a;
  std::vector<double> u(a.u.size());
  looking.foresee(a, view(force), u);
  const std::vector<geometry::TetId> gone{geometry::TetId(100), geometry::TetId(150)};
  ASSERT_TRUE(looking.remove(gone));
  ASSERT_TRUE(blind.remove(gone));
  ASSERT_TRUE(looking.step(a, view(force)));
  ASSERT_TRUE(blind.step(b, view(force)));
  EXPECT_EQ(a.u, b.u);
}

TEST_F(WarpedStepTest, AGuessMakesAYieldCheaperNotOther) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep warped = stepper(body);
  BodyState state = moving(random_vector(size, 0.01 * kEdge, 7), Vector::Zero(size));
  const Vector nothing = Vector::Zero(size), forces = random_vector(size, 0.1, 8);
  ASSERT_TRUE(warped.step(state, view(nothing)));
  std::vector<double> yield(state.u.size());
  warped.yield_to(view(forces), yield);
  const int from_nothing = warped.iterations();
  std::vector<double> again = yield, other = values_of(random_vector(size, 1, 9));
  for (std::size_t c = 0; c < other.size(); ++c)
    if (body.fixed[c / 3] != 0) other[c] = 0;
  warped.yield_to(view(forces), again);
  EXPECT_GT(from_nothing, 1);
  EXPECT_LE(warped.iterations(), 1);
  warped.yield_to(view(forces), other);
  EXPECT_LE(norm(sum(again, -1, yield)), kFloat * norm(yield));
  EXPECT_LE(norm(sum(other, -1, yield)), kFloat * norm(yield));
}

TEST_F(WarpedStepTest, AYieldThatIsNoNumberIsNoGuess) {
  WarpedStep warped = stepper(inertia(Held::kAtOneEnd));
  std::vector<double> yield(static_cast<std::size_t>(size));
  Vector forces = random_vector(size, 0.1, 8);
  forces[size - 2] = std::numeric_limits<double>::quiet_NaN();
  warped.yield_to(view(forces), yield);
  EXPECT_EQ(norm(yield), 0);
}

// Of so little mass that what an equation may lack would throw it out of the world.
TEST_F(WarpedStepTest, ANodeWhoseTissueIsGoneStaysWhereItIs) {
  const Inertia body = inertia(Held::kAtOneEnd);
  WarpedStep warped = stepper(body);
  BodyState state = moving(random_vector(size, 0.01 * kEdge, 6), Vector::Zero(size));
  const Vector force = weight(body, 5), push = random_vector(size, 0.1, 8);
  std::vector<double> yield(state.u.size());
  warped.yield_to(view(push), yield);  // a guess of when it was there
  ASSERT_TRUE(warped.step(state, view(force)));
  const std::size_t last = mesh.positions.size() - 1;
  std::vector<geometry::TetId> around;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    if (std::ranges::count(mesh.tetrahedra[t], geometry::NodeId(last)) > 0) around.emplace_back(t);
  ASSERT_TRUE(warped.remove(around));
  Vec3::Map(&state.v[3 * last]).setZero();
  const Vec3 left_at = Vec3::Map(&state.u[3 * last]);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(warped.step(state, view(force)));
  EXPECT_EQ(Vec3(Vec3::Map(&state.u[3 * last])), left_at);
  warped.yield_to(view(push), yield);
  EXPECT_EQ(Vec3::Map(&yield[3 * last]).norm(), 0) << "nothing pushes it";
}

TEST_F(WarpedStepTest, StepAllocatesNothing) {
  WarpedStep warped = stepper(inertia(Held::kAtOneEnd));
  BodyState state = moving(random_vector(size, 0.1 * kEdge, 4), Vector::Zero(size));
  const Vector nothing = Vector::Zero(size);
  const std::vector<geometry::TetId> one{geometry::TetId(7)};
  const std::vector<geometry::NodeId> nodes{geometry::NodeId(4), geometry::NodeId(30)};
  std::vector<float> block(36);
  const std::size_t before = heap_allocations();
  EXPECT_TRUE(warped.step(state, view(nothing)));
  EXPECT_TRUE(warped.remove(one));
  EXPECT_TRUE(warped.step(state, view(nothing)));
  warped.compliance(nodes, block);
  warped.restore();
  EXPECT_EQ(heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::physics
