#include "haptic_node/haptic_step.h"

#include "haptic_fixtures.h"
#include "physics/direct_solve.h"

namespace omentum::haptic_test {
namespace {

// Stored in float and solved in double, forces are good to 1e-5 (decision 26); the contact's own compliance,
// 1e-6 m/N beside about 1e-2 m/N, adds 1e-4.
constexpr double kForceTolerance = 1e-3;

const Vec3 kAbove(0.052, 0.047, 0.045);

TEST(HapticStep, NoForceWithoutContact) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove + Vec3(0, 0, 0.05));
  EXPECT_EQ(bench.move_to(kAbove, 10), Vec3::Zero());
  EXPECT_EQ(bench.result().contacts, 0);
}

TEST(HapticStep, TissuePushesBackAndLetsGo) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  const Vec3 pressed = bench.move_to(kAbove - Vec3(0, 0, 0.01), 100);
  EXPECT_GT(pressed.z(), 0.1);
  EXPECT_LT(pressed.head<2>().norm(), 0.2 * pressed.z());
  EXPECT_EQ(bench.move_to(kAbove + Vec3(0, 0, 0.001), 100), Vec3::Zero());
}

// The force that the node computes is the one that an independent finite element solution needs to hold the
// same nodes where they are.
TEST(HapticStep, ForceEqualsADirectConstrainedSolve) {
  for (const double friction : {0.0, 0.5}) {
    Bench bench(make_model(block(), {round_tool(), round_tool()}, friction));
    bench.place(1, kAbove + Vec3(0.015, 0.01, 0)).step_to(kAbove);
    for (int i = 0; i < 120; ++i) {
      bench.place(1, kAbove + Vec3(0.015, 0.01, -0.0001 * i));
      bench.step_to(kAbove + Vec3(0.00002 * i, 0, -0.0001 * i));
    }
    std::vector<physics::ImposedDisplacement> imposed;
    std::vector<Vec3> expected;
    Vec3 total = Vec3::Zero();
    for (const haptic::NodeForce& entry : bench.state().forces()) {
      const geometry::NodeId node = block().surface.node[entry.node];
      const auto same =
          std::find_if(imposed.begin(), imposed.end(), [&](const auto& i) { return i.node == node; });
      total += entry.force;
      if (same != imposed.end()) {
        expected[same - imposed.begin()] += entry.force;
        continue;
      }
      imposed.push_back(
          {node, haptic::contact_displacement(entry.body, entry.node, bench.state(), bench.work().bodies)});
      expected.push_back(entry.force);
    }
    ASSERT_GE(imposed.size(), 5u);
    const auto solution = physics::direct_solve(block().stiffness, block().fixed, imposed, {});
    Vec3 direct_total = Vec3::Zero();
    for (const Vec3& f : solution.holding_forces) direct_total += f;
    EXPECT_LE((direct_total - total).norm(), kForceTolerance * total.norm());
    EXPECT_LE((bench.output(0).force + bench.output(1).force + total).norm(), 1e-12);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LE((solution.holding_forces[i] - expected[i]).norm(), kForceTolerance * total.norm());
    }
  }
}

TEST(HapticStep, ToolPointsStayOutsideOfTheDeformedSurface) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  for (int i = 0; i <= 300; ++i)
    bench.step_to(kAbove + Vec3(0.00005 * i, 0.00003 * i, -0.00005 * std::min(i, 200)));
  for (int i = 0; i < 5; ++i) bench.step();  // at rest the contact settles
  for (const Vec3& p : bench.state().tools[0].now) {
    bench.surface().evaluate({p - Vec3::Constant(0.005), p + Vec3::Constant(0.005)});
    // settled contacts lie on the surface to within the solver's tolerance and one tick's turn of the normals
    EXPECT_FALSE([&] {
      const auto inside = bench.surface().nearest_if_inside(p, 0.005);
      return inside && (bench.surface().position(*inside) - p).norm() > 2e-5;
    }());
  }
}

TEST(HapticStep, FastMotionThroughAThinPlateIsCaught) {
  for (const double speed_m_tick : {0.001, 0.005, 0.03}) {
    Bench bench(make_model(plate(), {needle()}));
    Vec3 tip(0.0613, 0.0587, 0.0201);
    bench.step_to(tip);
    while (tip.z() > -0.01) bench.step_to(tip -= Vec3(0, 0, speed_m_tick));
    EXPECT_EQ(bench.result().contacts, 1) << "speed " << speed_m_tick;
    EXPECT_GT(bench.output().force.z(), 0);
  }
}

// A plate thinner than one tick's motion is pushed over a resting needle by another tool.
TEST(HapticStep, SurfaceThatMovesOverARestingPointIsNoticed) {
  Bench bench(make_model(plate(), {round_tool(), needle()}));
  const Vec3 below(0.06, 0.066, -0.001);
  bench.input(1).frame.q_WT = Eigen::Quaterniond(0, 1, 0, 0);
  bench.place(1, below).step_to({0.06, 0.06, 0.01});
  bench.move_to({0.06, 0.06, -0.008}, 60);
  EXPECT_LT(bench.output(1).force.z(), 0) << "the plate presses the needle down";
}

// The same from a needle's view that goes the other way: in one tick tissue rises past where the needle was,
// and the needle goes far deeper than the tissue rose.
TEST(HapticStep, SurfaceThatMovesOverAPointOnItsWayInIsNoticed) {
  Bench bench(make_model(block(), {round_tool(), needle()}));
  const Vec3 beside = kAbove + Vec3(0.012, 0, 0);
  bench.place(1, beside).step_to(kAbove);
  bench.move_to(kAbove - Vec3(0, 0, 0.01), 100);
  const haptic::SurfacePoint under = bench.surface().slide({TriangleId(0), Vec3(1, 0, 0)}, beside);
  const Vec3 dented = bench.surface().position(under);
  bench.move_to(dented + Vec3(0, 0, 5e-5), 100, 1);  // rests just above the dent's flank
  ASSERT_EQ(bench.output(1).force, Vec3::Zero());
  bench.step_to(kAbove - Vec3(0, 0, 0.009));    // the flank will rise by more than that in the next tick ...
  bench.step_to(dented - Vec3(0, 0, 2e-3), 1);  // ... in which the needle goes in
  for (int i = 0; i < 3; ++i) bench.step();
  EXPECT_GT(bench.output(1).force.z(), 0);
}

TEST(HapticStep, AToolThatAppearsInsideIsNotPushedOut) {
  Bench bench(make_model(block(), {needle()}));
  EXPECT_EQ(bench.step_to({0.05, 0.05, 0.028}), Vec3::Zero());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(bench.step().contacts, 0);
  EXPECT_EQ(bench.move_to({0.05, 0.05, 0.06}, 100), Vec3::Zero()) << "it may leave freely";
  EXPECT_GT(bench.move_to({0.05, 0.05, 0.035}, 50).z(), 0) << "outside it is a tool like any other";
}

TEST(HapticStep, AToolThatAppearsInsideIsHeldBackFromGoingDeeper) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to({0.05, 0.05, 0.030});
  const Vec3 deeper = bench.move_to({0.05, 0.05, 0.025}, 50);
  Bench fresh(make_model(block(), {round_tool()}));
  fresh.step_to({0.05, 0.05, 0.041});
  const Vec3 pressed = fresh.move_to({0.05, 0.05, 0.035}, 60);
  EXPECT_NEAR(deeper.z(), pressed.z(), 0.3 * pressed.z()) << "as the same way feels from the surface";
  EXPECT_LE(bench.move_to({0.05, 0.05, 0.0301}, 50).z(), 0.1 * deeper.z()) << "and lets go where it began";
}

// Whatever it does inside and outside, it gets no energy out of where it began.
TEST(HapticStep, AToolThatAppearsInsideGainsNothing) {
  for (const double friction : {0.0, 0.3}) {
    Bench bench(make_model(block(), {round_tool()}, friction));
    Vec3 tip(0.05, 0.05, 0.03), force = bench.step_to(tip);
    double given_j = 0, taken_j = 0;
    for (int i = 1; i <= 4000; ++i) {
      const double t = 0.005 * i;
      // deeper first, then up to the surface, and so on
      const Vec3 next =
          Vec3(0.05, 0.05, 0.03) - 0.01 * Vec3(0.5 * std::sin(1.1 * t), 0.5 * std::sin(0.7 * t), std::sin(t));
      const Vec3 middle = 0.5 * (force + bench.step_to(next));
      const double work = middle.dot(next - tip);
      (work > 0 ? given_j : taken_j) += std::abs(work);
      tip = next;
      force = bench.output().force;
      // sampling and facets: what a tool that began outside may show as well
      ASSERT_LE(given_j, 1.02 * taken_j + 1e-6) << "friction " << friction << ", tick " << i;
    }
    EXPECT_GT(taken_j, 1e-3) << "it was meant to press";
  }
}

TEST(HapticStep, ContactIsOneSided) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.01 * i;
    bench.step_to(kAbove +
                  Vec3(0.01 * std::sin(t), 0.01 * std::cos(0.7 * t), -0.006 + 0.006 * std::cos(1.3 * t)));
    for (const haptic::ToolContact& contact : bench.state().active()) {
      EXPECT_LE(contact.force.dot(contact.place.normal), 0);
    }
  }
}

TEST(HapticStep, FrictionStaysInItsConeAndOpposesMotion) {
  constexpr double kFriction = 0.3;
  Bench bench(make_model(block(), {needle()}, kFriction));
  bench.step_to({0.03, 0.05, 0.041});
  const Vec3 pressed = bench.move_to({0.03, 0.05, 0.036}, 50);
  EXPECT_LT(pressed.head<2>().norm(), 0.2 * pressed.z());
  const Vec3 dragged = bench.move_to({0.06, 0.05, 0.036}, 600);
  EXPECT_LT(dragged.x(), -0.1 * dragged.z()) << "the tissue holds the tool back";
  for (const haptic::ToolContact& contact : bench.state().active()) {
    const double push = -contact.force.dot(contact.place.normal);
    EXPECT_LE((contact.force + push * contact.place.normal).norm(), kFriction * push * (1 + 1e-9));
  }
}

TEST(HapticStep, StickingContactReturnsToItsForce) {
  Bench bench(make_model(block(), {needle()}, 2.0));
  bench.step_to({0.05, 0.05, 0.041});
  const Vec3 pressed = bench.move_to({0.05, 0.05, 0.036}, 50);
  EXPECT_LT(bench.move_to({0.052, 0.05, 0.036}, 50).x(), -1e-3);
  const Vec3 back = bench.move_to({0.05, 0.05, 0.036}, 50);
  EXPECT_LE((back - pressed).norm(), 1e-3 * pressed.norm());
}

TEST(HapticStep, GraspPullsUntilTheJawsOpen) {
  haptic::ToolModel grasper = round_tool();
  grasper.grasps = true;
  Bench bench(make_model(block(), {grasper}));
  bench.place(0, kAbove, 0.5).step();
  for (int i = 0; i < 80; ++i) bench.place(0, kAbove - Vec3(0, 0, 0.0001 * i), 0.5).step();
  const Vec3 before = bench.output().force;
  EXPECT_EQ(bench.output().grasp_count, 0u);
  const Vec3 tip = bench.input().frame.p_WT;
  bench.place(0, tip, 0.05).step();
  EXPECT_TRUE(bench.output().grasping);
  EXPECT_EQ(bench.output().grasp_count, 1u);
  EXPECT_LE((bench.output().force - before).norm(), 0.02 * before.norm()) << "closing alone is no force";
  for (int i = 0; i < 150; ++i) bench.place(0, tip + Vec3(0, 0, 0.0001 * i), 0.05).step();
  EXPECT_LT(bench.output().force.z(), -0.1) << "grasped tissue pulls";
  bench.place(0, bench.input().frame.p_WT, 0.5).step();
  EXPECT_FALSE(bench.output().grasping);
  EXPECT_EQ(bench.output().force, Vec3::Zero());
}

TEST(HapticStep, AClosedProbeNeverGrasps) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  bench.move_to(kAbove - Vec3(0, 0, 0.008), 80);
  EXPECT_EQ(bench.output().grasp_count, 0u);
}

TEST(HapticStep, TwoToolsFeelEachOther) {
  const Vec3 left(0.042, 0.05, 0.041), right(0.058, 0.05, 0.041), down(0, 0, 0.008);
  Bench alone(make_model(block(), {needle()}));
  alone.step_to(left);
  const Vec3 single = alone.move_to(left - down, 80);
  Bench both(make_model(block(), {needle(), needle()}));
  both.place(1, right).step_to(left);
  for (int i = 1; i <= 80; ++i) both.place(1, right - down * i / 80).step_to(left - down * i / 80);
  EXPECT_LT(both.output(0).force.z(), 0.95 * single.z()) << "the neighbour pushes part of the tissue away";
  EXPECT_NEAR(both.output(0).force.z(), both.output(1).force.z(), 0.2 * single.z());
}

TEST(HapticStep, StepsDoNotDependOnTheirNumber) {
  const Vec3 below = kAbove - Vec3(0, 0, 0.01);
  Vec3 reference = Vec3::Zero();
  for (const int ticks : {1000, 300, 100, 30}) {
    Bench bench(make_model(block(), {round_tool()}));
    bench.step_to(kAbove);
    bench.move_to(below, ticks);
    for (int i = 0; i < 10; ++i) bench.step();
    if (ticks == 1000) reference = bench.output().force;
    EXPECT_LE((bench.output().force - reference).norm(), 0.01 * reference.norm()) << ticks << " ticks";
  }
}

// Far beyond what a linear model can say, a press must still feel like one thing: twice as deep as an element
// is wide, the dent is a funnel. (With the normals of the deformed shape the force flickered here.)
TEST(HapticStep, ADeepPressIsSteadyAndSlidesWithoutJumps) {
  constexpr double kStep_m = 5e-5, kElement_m = 0.01;
  // F = d / W, and W = sum k_a k_b C_ab is quadratic over an element: |dW/dx| <= 2 W_node / h with W_node <=
  // 2 W
  constexpr double kLargestChange = 4 * kStep_m / kElement_m;
  for (const double friction : {0.0, 0.3}) {
    Bench bench(make_model(block(), {needle()}, friction));
    bench.step_to({0.031, 0.048, 0.041});
    bench.move_to({0.031, 0.048, 0.020}, 420);
    Vec3 before = bench.output().force;
    for (int i = 0; i < 200; ++i) {
      bench.step();
      EXPECT_TRUE(i < 50 || (bench.output().force - before).norm() < 1e-6) << "held, friction " << friction;
      before = bench.output().force;
    }
    for (double x = 0.031; x < 0.065; x += kStep_m) {
      const Vec3 force = bench.step_to({x, 0.048, 0.020});
      EXPECT_LE((force - before).norm(), kLargestChange * force.norm())
          << "slid to " << x << ", friction " << friction;
      before = force;
    }
  }
}

// What no device can have (and somebody sent): the tool that has it is told, the other one goes on as if it
// were alone, and nothing of it stays.
TEST(HapticStep, AToolThatCannotBeComputedWithStopsAlone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 beside = kAbove + Vec3(0.015, 0, 0), deep(0, 0, -0.008);
  Bench alone(make_model(block(), {round_tool()}));
  alone.step_to(kAbove);
  const Vec3 single = alone.move_to(kAbove + deep, 80);
  for (int kind = 0; kind < 3; ++kind) {
    Bench both(make_model(block(), {round_tool(), round_tool()}));
    both.place(1, beside).step_to(kAbove);
    for (int i = 1; i <= 40; ++i) both.place(1, beside + deep * i / 80).step_to(kAbove + deep * i / 80);
    if (kind == 0) both.input(1).max_stiffness_n_m = 5e-324;
    if (kind == 1) both.input(1).max_stiffness_n_m = kNan;
    if (kind == 2) both.input(1).frame.p_WT.y() = kNan;
    both.move_to(kAbove + deep, 40);
    EXPECT_FALSE(both.output(1).force.allFinite());
    EXPECT_LE((both.output(0).force - single).norm(), 0.05 * single.norm()) << "kind " << kind;
    for (const haptic::NodeForce& entry : both.state().forces()) EXPECT_TRUE(entry.force.allFinite());
    both.input(1) = {};
    both.move_to(kAbove, 80);
    EXPECT_LE((both.move_to(kAbove + deep, 80) - single).norm(), 1e-3 * single.norm()) << "kind " << kind;
  }
}

TEST(HapticStep, RelocatedToolsLetGo) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  EXPECT_GT(bench.move_to(kAbove - Vec3(0, 0, 0.01), 100).z(), 0);
  bench.input().relocated = true;
  EXPECT_EQ(bench.step_to(kAbove), Vec3::Zero());
}

TEST(HapticStep, DisengagedToolsTouchNothing) {
  Bench bench(make_model(block(), {round_tool()}));
  bench.step_to(kAbove);
  bench.move_to(kAbove - Vec3(0, 0, 0.01), 100);
  bench.input().engaged = false;
  bench.step();
  EXPECT_EQ(bench.output().force, Vec3::Zero());
  EXPECT_EQ(bench.state().contact_count, 0);
}

// Torque about the tip: of a force on a point beside it.
TEST(HapticStep, TorqueIsAboutTheTip) {
  haptic::ToolModel crank;
  crank.points.emplace_back(0.02, 0, 0);
  Bench bench(make_model(block(), {crank}));
  bench.step_to({0.04, 0.05, 0.041});
  const Vec3 force = bench.move_to({0.04, 0.05, 0.035}, 60);
  const Vec3 expected = Vec3(0.02, 0, 0).cross(force);
  EXPECT_LE((bench.output().torque - expected).norm(), 1e-12);
}

TEST(HapticStep, SpreadModeImposesThePointsDisplacement) {
  haptic::HapticModel model = make_model(block(), {needle()});
  model.mode = haptic::ContactMode::kSpread;
  Bench bench(std::move(model));
  bench.step_to({0.0533, 0.0471, 0.041});
  const Vec3 force = bench.move_to({0.0533, 0.0471, 0.035}, 60);
  for (int i = 0; i < 5; ++i) bench.step();
  EXPECT_GT(force.z(), 0);
  ASSERT_EQ(bench.state().contact_count, 1);
  const haptic::ToolContact& contact = bench.state().contacts[0];
  const Vec3 gap = bench.state().tools[0].now[0] - bench.surface().position(contact.held);
  EXPECT_LE(std::abs(gap.dot(contact.place.normal)), 1e-5);
  EXPECT_EQ(bench.move_to({0.0533, 0.0471, 0.042}, 60), Vec3::Zero()) << "a pulling contact is dropped";
}

TEST(HapticStep, TrocarKeepsTheShaftOnThePivot) {
  const Vec3 pivot(0.02, -0.1, 0.3);
  haptic::ToolFrame measured{kAbove, Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized()};
  const haptic::ToolFrame frame = haptic::through_trocar(measured, pivot);
  EXPECT_EQ(frame.p_WT, measured.p_WT);
  EXPECT_LE(((frame.q_WT * Vec3::UnitZ()) - (pivot - kAbove).normalized()).norm(), 1e-12);
}

}  // namespace
}  // namespace omentum::haptic_test
