// A hybrid organ whose dynamic part follows the co-rotational law: it may be pulled, turned and lifted away.
#include "physics/dynamics/warped_step.h"
#include "physics/hybrid/hybrid_step.h"
#include "tests/physics/hybrid/hybrid_beam.h"
#include "tests/support/heap_count.h"

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::TetId;
using test::HybridBeam;
using test::Values;

constexpr double kWarpedTick_s = 0.01;
constexpr double kBeamLength = 0.12;  // m

class WarpedHybridTest : public testing::Test {
 protected:
  HybridStep hybrid(const HybridBeam& beam, DynamicLaw law = DynamicLaw::kCorotational) const {
    HybridBody body = beam.body();
    body.law = law;
    return {std::move(body), kWarpedTick_s, 24};
  }
  static BodyState at_rest(const HybridBeam& beam) { return state_at_rest(beam.mesh.positions.size()); }
  static double energy(const HybridBeam& beam, HybridStep& hybrid, const BodyState& state) {
    double kinetic_j = 0;
    for (const NodeId n : beam.split.dynamic.node)
      kinetic_j += beam.inertia.mass[n] * Vec3(state.v.data() + 3 * n).squaredNorm() / 2;
    return hybrid.elastic_energy(state.u) + kinetic_j;
  }
  static void damp(HybridBeam& beam) {
    beam.inertia.mass_damping_per_s = 10;
    beam.inertia.stiffness_damping_s = 0.01;
  }
  static Eigen::Map<Vec3> at(Values& values, NodeId n) { return Eigen::Map<Vec3>(values.data() + 3 * n); }
  // What connects both parts.
  static std::vector<TetId> border(const HybridBeam& beam) {
    std::vector<TetId> at_border;
    for (const TetId t : beam.split.dynamic.tetrahedron)
      if (std::ranges::any_of(beam.mesh.tetrahedra[t],
                              [&](NodeId n) { return beam.split.precomputed.own_node[n].valid(); }))
        at_border.push_back(t);
    return at_border;
  }
  // Dynamic nodes that are of no tetrahedron at the border, once it is cut.
  static std::vector<NodeId> freed(const HybridBeam& beam) {
    std::vector<NodeId> nodes;
    for (const NodeId n : beam.split.dynamic.node)
      if (!beam.split.precomputed.own_node[n].valid()) nodes.push_back(n);
    return nodes;
  }
};

TEST_F(WarpedHybridTest, UnderSmallLoadsItIsTheLinearHybrid) {
  HybridBeam beam(Vec3(0, 0, -1e-4));
  damp(beam);
  Values pressed = beam.weights;
  at(pressed, beam.nearest({0.03, 0.015, 0.03})) += Vec3(1, 2, -5) * 1e-7;
  at(pressed, beam.nearest({0.105, 0.015, 0.03})) += Vec3(2, 0, 5) * 1e-7;
  HybridStep warped = hybrid(beam), linear = hybrid(beam, DynamicLaw::kLinear);
  BodyState a = at_rest(beam), b = a;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(warped.step(a, pressed) && linear.step(b, pressed));
    // what a step's equation lacks goes to the next one: the first have none before them
    ASSERT_LE(beam.difference(a.u, b.u), i < 10 ? 2e-3 : 1e-4) << i;
  }
}

// The precomputed part is linear: what it is off by goes with the square of how far the border turns.
TEST_F(WarpedHybridTest, ItRestsWhereTheSingleModelDoesAsFarAsThePrecomputedPartTurnsLittle) {
  const struct { double stiffer, most; } cases[] = {{30, 2e-2}, {100, 2e-3}, {1000, 2e-5}};
  for (const auto& [stiffer, most] : cases) {
    HybridBeam beam(Vec3(0, 0, -9.81), stiffer);
    damp(beam);
    HybridStep part = hybrid(beam);
    WarpedStep whole(beam.mesh, beam.material, beam.inertia, Corotational(beam.mesh, beam.material),
                     {.step_s = kWarpedTick_s});
    BodyState a = at_rest(beam), b = a;
    for (int i = 0; i < 400; ++i) ASSERT_TRUE(part.step(a, beam.weights) && whole.step(b, beam.weights));
    ASSERT_LT(at(b.u, beam.nearest({0.12, 0.015, 0.03})).z(), -0.025) << "half of what moves";
    EXPECT_LE(beam.difference(a.u, b.u), most) << stiffer << " times as stiff";
  }
}

TEST_F(WarpedHybridTest, WhatIsPulledTurnedAndLetGoGainsNoEnergy) {
  HybridBeam beam(Vec3::Zero());
  HybridStep part = hybrid(beam);
  BodyState state = at_rest(beam);
  Values pull(beam.components()), nothing(beam.components());
  for (std::size_t n = 0; n < beam.mesh.positions.size(); ++n) {
    const Vec3& p = beam.mesh.positions[n];
    if (p.x() > 0.119) Vec3::Map(&pull[3 * n]) = Vec3(-0.02, 0.3 * (p.z() - 0.015), 0.05);
  }
  double before = 0, most = 0;
  for (int i = 0; i < 500; ++i) {
    if (i % 100 == 50) {
      ASSERT_TRUE(
          part.remove({&beam.split.dynamic.tetrahedron.at(static_cast<std::size_t>(i / 50 + 12)), 1}));
    }
    before = std::min(before, energy(beam, part, state));  // what is cut takes its energy along
    const Values& external = i < 100 ? pull : nothing;
    ASSERT_TRUE(part.step(state, external));
    const double after = energy(beam, part, state);
    ASSERT_LE(after, before + part.work(external, state.v) + 1e-9 * most) << i;
    most = std::max(most, after);
    if (i == 99) {
      EXPECT_GT(at(state.u, beam.nearest({0.12, 0.015, 0.03})).z(), 0.09) << "far";
    }
    before = after;
  }
  EXPECT_LT(before, 0.1 * most);
}

TEST_F(WarpedHybridTest, AFreedSegmentFeelsNoForceHoweverItIsTurned) {
  HybridBeam beam(Vec3::Zero());
  HybridStep part = hybrid(beam), linear = hybrid(beam, DynamicLaw::kLinear);
  ASSERT_TRUE(part.remove(border(beam)) && linear.remove(border(beam)));
  BodyState a = at_rest(beam);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Vec3(1, -1, 3).normalized()).toRotationMatrix();
  for (const NodeId n : freed(beam)) at(a.u, n) = R * beam.mesh.positions[n] - beam.mesh.positions[n];
  BodyState b = a;
  const Values nothing(beam.components());
  ASSERT_TRUE(part.step(a, nothing) && linear.step(b, nothing));
  EXPECT_LE(test::norm(a.v), 1e-12);
  EXPECT_GE(test::norm(b.v), 1) << "the linear law takes the turn for a strain";
}

TEST_F(WarpedHybridTest, AFreedSegmentFallsAndWhatIsLeftRestsByItself) {
  HybridBeam beam;
  beam.inertia.stiffness_damping_s = 0.01;
  HybridStep part = hybrid(beam);
  BodyState state = at_rest(beam);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(part.step(state, beam.weights));
  ASSERT_TRUE(part.remove(border(beam)));
  CarriedMass carried(beam.mesh, beam.material, beam.inertia.mass);
  carried.remove(border(beam));
  const auto mass = [&](NodeId n) { return carried.kg()[static_cast<std::size_t>(n)]; };
  Vec3 weight = Vec3::Zero(), before = Vec3::Zero(), after = Vec3::Zero();
  for (const NodeId n : freed(beam)) {
    weight += at(beam.weights, n);
    before += mass(n) * at(state.v, n);
  }
  constexpr int kSteps = 500;
  for (int i = 0; i < kSteps; ++i) ASSERT_TRUE(part.step(state, beam.weights));
  for (const NodeId n : freed(beam)) after += mass(n) * at(state.v, n);
  const Vec3 impulse = kSteps * kWarpedTick_s * weight;
  EXPECT_LE((after - before - impulse).norm(), 1e-6 * impulse.norm());

  std::vector<Vec3> loads;
  for (const NodeId n : beam.split.precomputed.node) loads.emplace_back(at(beam.weights, n));
  const Stiffness K = assemble_stiffness(beam.split.precomputed.mesh, beam.material);
  const std::vector<Vec3> rest = direct_solve(K, beam.fixed, {}, loads).displacements;
  for (std::size_t n = 0; n < rest.size(); ++n) {
    const NodeId whole = beam.split.precomputed.node[n];
    if (!beam.is_known(static_cast<std::size_t>(whole))) continue;
    ASSERT_LE((at(state.u, whole) - rest[n]).norm(), 1e-6 * kBeamLength) << n;
  }
}

// What a hand is told is the compliance at rest, turned; what the body does is the whole equation.
TEST_F(WarpedHybridTest, ThePatchOnTheBorderYieldsAsTheBodyDoesWhereItIsBent) {
  HybridBeam beam(Vec3(0, 0, -9.81), 100);
  damp(beam);
  HybridStep part = hybrid(beam);
  BodyState state = at_rest(beam);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(part.step(state, beam.weights));
  std::vector<NodeId> nodes;
  for (const double x : {0.045, 0.06, 0.075, 0.09})
    for (const double y : {0.0, 0.03}) nodes.push_back(beam.nearest({x, y, 0.03}));
  const std::size_t width = 3 * nodes.size();
  std::vector<float> block(width * width);
  for (int again = 0; again < 2; ++again) part.compliance(nodes, block);  // what is known was not turned yet
  const double largest = static_cast<double>(*std::ranges::max_element(block));
  for (std::size_t p = 0; p < width; ++p) {
    Values force(beam.components()), yield(force.size());
    at(force, nodes[p / 3])[static_cast<Eigen::Index>(p % 3)] = 1;
    part.yield_to(force, yield);
    for (std::size_t q = 0; q < width; ++q)
      ASSERT_NEAR(at(yield, nodes[q / 3])[static_cast<Eigen::Index>(q % 3)],
                  static_cast<double>(block[q * width + p]), 0.06 * largest);
  }
}

TEST_F(WarpedHybridTest, ItAllocatesNothing) {
  HybridBeam beam;
  HybridStep part = hybrid(beam);
  BodyState state = at_rest(beam);
  Values u(state.u.size());
  const std::vector<TetId> some = border(beam);
  const std::vector<NodeId> nodes{beam.nearest({0.045, 0.015, 0.03}), beam.nearest({0.075, 0.015, 0.03})};
  std::vector<float> block(36);
  const std::size_t before = test::heap_allocations();
  bool sound = part.step(state, beam.weights) && part.remove(some);
  part.foresee(state, beam.weights, u);
  part.yield_to(beam.weights, u);
  part.compliance(nodes, block);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(sound);
}

}  // namespace
}  // namespace omentum::physics
