// A hybrid organ whose parts share no nodes, against the same two meshes as one model.
#include "tests/physics/hybrid/tied_beam.h"
#include "tests/support/heap_count.h"

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::TetId;
using test::TiedBeam;
using test::TiedReference;
using test::Values;

constexpr double kTiedStep_s = 0.01;
// Tensors are stored in float; a fine border that is held to coarse shapes makes forces that nearly cancel.
constexpr double kTiedFloat = 2e-5;

class TiedHybridTest : public testing::Test {
 protected:
  TiedHybridTest() {
    beam_.inertia.mass_damping_per_s = 2;
    beam_.inertia.stiffness_damping_s = 0.01;
  }
  HybridStep hybrid(DynamicLaw law = DynamicLaw::kLinear) const { return {beam_.body(law), kTiedStep_s, 24}; }

  // A press on each part's upper side and on either side of the border, beside the weight.
  Values pressed() const {
    Values f = beam_.weights;
    for (const double x : {0.03, 0.06}) press({x, 0.015, 0.03}, false, f);
    for (const double x : {0.06, 0.105}) press({x, 0.015, 0.03}, true, f);
    return f;
  }
  void press(const Vec3& place, bool of_dynamic, Values& f) const {
    Vec3::Map(&f[3 * static_cast<std::size_t>(beam_.nearest(place, of_dynamic))]) += Vec3(0.01, 0.02, -0.05);
  }
  // Where the border's lower half was: some leaders lose all that they had.
  std::vector<TetId> below_the_border() const {
    std::vector<TetId> found;
    for (const TetId t : beam_.split.dynamic.tetrahedron) {
      Vec3 centre = Vec3::Zero();
      for (const NodeId n : beam_.mesh.tetrahedra[t]) centre += beam_.mesh.positions[n] / 4;
      if (centre.x() < 0.075 && centre.z() < 0.015) found.push_back(t);
    }
    return found;
  }
  double energy(HybridStep& hybrid, const BodyState& state) const {
    return hybrid.elastic_energy(state.u) + kinetic_energy(hybrid.mass(), state.v);
  }

  TiedBeam beam_;
};

TEST_F(TiedHybridTest, ItIsTheStepOfTheSameTwoMeshesAsOneModel) {
  HybridStep hybrid = this->hybrid();
  TiedReference whole(beam_, kTiedStep_s);
  BodyState a = state_at_rest(beam_.mesh.positions.size()), b = a;
  const Values pressed = this->pressed();
  for (int i = 0; i < 30; ++i) {
    if (i == 20) {
      ASSERT_TRUE(hybrid.remove(below_the_border()));
      whole.remove(below_the_border());
    }
    const Values& external = i < 10 ? beam_.weights : pressed;
    ASSERT_TRUE(hybrid.step(a, external));
    whole.step(b, external);
    ASSERT_LE(beam_.difference(a.u, b.u), kTiedFloat) << i;
  }
  EXPECT_LE(beam_.difference(a.v, b.v), 1e-2);
}

TEST_F(TiedHybridTest, ItRestsWhereTheOneModelDoes) {
  HybridStep hybrid = this->hybrid();
  const TiedReference whole(beam_, kTiedStep_s);
  for (const Values& external : {beam_.weights, pressed()}) {
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    for (int i = 0; i < 1500; ++i) ASSERT_TRUE(hybrid.step(state, external));
    const double off = beam_.difference(state.u, whole.rest(external));
    RecordProperty("off", std::to_string(off));
    EXPECT_LE(off, kTiedFloat);
  }
}

TEST_F(TiedHybridTest, ItForeseesTheNextStepAndYieldsAsTheOneModel) {
  HybridStep hybrid = this->hybrid();
  const TiedReference whole(beam_, kTiedStep_s);
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  Values foreseen(state.u.size()), yield(state.u.size()), forces(state.u.size());
  for (int i = 0; i < 5; ++i) {
    hybrid.foresee(state, pressed, foreseen);
    ASSERT_TRUE(hybrid.step(state, pressed));
    ASSERT_LE(beam_.difference(foreseen, state.u), 1e-6);
  }
  for (const bool of_dynamic : {false, true}) {
    std::ranges::fill(forces, 0.0);
    press({0.06, 0.015, 0.03}, of_dynamic, forces);
    hybrid.yield_to(forces, yield);
    EXPECT_LE(beam_.difference(yield, whole.yield_to(forces)), kTiedFloat);
  }
}

// On both sides of the border, and on it nodes of both parts.
TEST_F(TiedHybridTest, ThePatchOnTheBorderYieldsAsTheOneModelDoes) {
  HybridStep hybrid = this->hybrid();
  TiedReference whole(beam_, kTiedStep_s);
  ASSERT_TRUE(hybrid.remove(below_the_border()));
  whole.remove(below_the_border());
  std::vector<NodeId> nodes;
  for (const double y : {0.0, 0.015, 0.03}) {
    for (const double x : {0.045, 0.06}) nodes.push_back(beam_.nearest({x, y, 0.03}, false));
    for (const double x : {0.06, 0.075}) nodes.push_back(beam_.nearest({x, y, 0.03}, true));
  }
  const std::size_t width = 3 * nodes.size();
  std::vector<float> block(width * width);
  hybrid.compliance(nodes, block);
  const float largest = *std::ranges::max_element(block);
  for (std::size_t p = 0; p < width; ++p) {
    Values force(beam_.components());
    force[3 * static_cast<std::size_t>(nodes[p / 3]) + p % 3] = 1;
    const Values yield = whole.yield_to(force);
    for (std::size_t q = 0; q < width; ++q)
      ASSERT_NEAR(block[q * width + p], yield[3 * static_cast<std::size_t>(nodes[q / 3]) + q % 3],
                  kTiedFloat * static_cast<double>(largest));
  }
}

// The slaves keep to what leads them, whatever floats make of the rest: no gap opens at the border.
TEST_F(TiedHybridTest, TheBorderHasNoGap) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  for (int i = 0; i < 400; ++i) ASSERT_TRUE(hybrid.step(state, pressed()));
  double largest = 0, gap = 0;
  for (std::size_t s = 0; s < beam_.tie.slaves.size(); ++s) {
    const NodeId n = beam_.split.precomputed.node[beam_.surface.node[beam_.tie.slaves[s]]];
    Vec3 led = Vec3::Zero();
    for (std::size_t m = 0; m < beam_.tie.map.masters.size(); ++m)
      led += beam_.tie.map.P(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(m)) *
             Vec3(state.u.data() + 3 * beam_.split.dynamic.node[beam_.tie.map.masters[m]]);
    largest = std::max(largest, led.norm());
    gap = std::max(gap, (Vec3(state.u.data() + 3 * n) - led).norm());
  }
  EXPECT_LE(gap, 1e-6 * largest) << "what is left of the motion";
}

TEST_F(TiedHybridTest, EnergyNeverGrowsByMoreThanTheWork) {
  beam_.inertia.mass_damping_per_s = beam_.inertia.stiffness_damping_s = 0;
  const Values pressed = this->pressed();
  for (const DynamicLaw law : {DynamicLaw::kLinear, DynamicLaw::kCorotational}) {
    HybridStep hybrid = this->hybrid(law);
    BodyState state = state_at_rest(beam_.mesh.positions.size());
    double largest = 0;
    const std::vector<TetId> gone = below_the_border();
    for (std::size_t i = 0; i < 150; ++i) {
      if (i % 10 == 5 && i / 10 < gone.size()) {
        ASSERT_TRUE(hybrid.remove(std::span(&gone[i / 10], 1)));
      }
      const Values& external = i / 30 % 2 == 0 ? beam_.weights : pressed;
      const double before = energy(hybrid, state);
      ASSERT_TRUE(hybrid.step(state, external));
      const double after = energy(hybrid, state), work = hybrid.work(external, state.v);
      largest = std::max({largest, after, std::abs(work)});
      ASSERT_LE(after, before + work + 1e-5 * largest) << "step " << i;
    }
  }
}

TEST_F(TiedHybridTest, LeadersThatLoseAllTheirTissueStayBounded) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  const auto sag = [&] {
    double most = 0;
    for (const NodeId m : beam_.tie.map.masters)
      most = std::max(most, Vec3(state.u.data() + 3 * beam_.split.dynamic.node[m]).norm());
    return most;
  };
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(hybrid.step(state, pressed));
  const double before = sag();
  // all that touches the border: the rest of the dynamic part falls
  std::vector<TetId> gone;
  for (const TetId t : beam_.split.dynamic.tetrahedron)
    if (std::ranges::any_of(beam_.mesh.tetrahedra[t],
                            [&](NodeId n) { return beam_.mesh.positions[n].x() < 0.0601; }))
      gone.push_back(t);
  ASSERT_TRUE(hybrid.remove(gone));
  Values left = beam_.weights;  // nothing is left for weights on the leaders to pull at
  for (const NodeId m : beam_.tie.map.masters)
    Vec3::Map(&left[3 * static_cast<std::size_t>(beam_.split.dynamic.node[m])]).setZero();
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(hybrid.step(state, left));
  EXPECT_LE(sag(), 0.9 * before) << "the precomputed half holds its border, which bears less now";
  EXPECT_LE(state.u[3 * static_cast<std::size_t>(beam_.nearest({0.12, 0.015, 0.03}, true)) + 2], -1)
      << "it fell";
}

TEST_F(TiedHybridTest, WhatWasCutComesBackAndNothingIsAllocated) {
  HybridStep hybrid = this->hybrid();
  BodyState state = state_at_rest(beam_.mesh.positions.size());
  const Values pressed = this->pressed();
  const std::vector<TetId> some = below_the_border();
  const std::vector<NodeId> nodes{beam_.nearest({0.06, 0.015, 0.03}, false),
                                  beam_.nearest({0.06, 0.015, 0.03}, true)};
  Values before(pressed.size()), cut(before), after(before);
  std::vector<float> block(36);
  const std::size_t allocations = test::heap_allocations();
  hybrid.yield_to(pressed, before);
  bool sound = hybrid.step(state, pressed) && hybrid.remove(some);
  hybrid.yield_to(pressed, cut);
  hybrid.foresee(state, pressed, after);
  hybrid.compliance(nodes, block);
  hybrid.restore();
  hybrid.yield_to(pressed, after);
  EXPECT_EQ(test::heap_allocations(), allocations);
  EXPECT_TRUE(sound);
  EXPECT_NE(before, cut);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace omentum::physics
