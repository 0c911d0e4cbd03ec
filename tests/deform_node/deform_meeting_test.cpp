// Organs with masses that meet one another, by the real models.
#include "tests/deform_node/tissue_block.h"

#include "deform_node/organ_collision.h"
#include "tests/support/heap_count.h"

namespace omentum::deform {
namespace {

struct Meeting {
  explicit Meeting(std::vector<Block*> met) : blocks(std::move(met)), collision(models(blocks)) {}
  static std::vector<OrganModel*> models(const std::vector<Block*>& blocks) {
    std::vector<OrganModel*> models;
    for (Block* block : blocks) models.push_back(block->model.get());
    return models;
  }
  void pass(double seconds) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) tick();
  }
  void tick(const TickLoads& on_first = {}) {
    for (Block* block : blocks) block->model->step(block == blocks[0] ? on_first : TickLoads{}, kTick_s);
    EXPECT_TRUE(collision.run());
    for (Block* block : blocks) EXPECT_FALSE(block->model->status().diverged);
  }
  void reset() {
    for (Block* block : blocks) block->model->reset();
    for (std::size_t i = 0; i < blocks.size(); ++i) collision.reset(i);
  }
  std::vector<Block*> blocks;
  OrganCollision collision;
};

/// Right through all at `x`.
CutStroke stroke_at(double x) {
  return {
      .tool = 0, .cut = 1, .from = {Vec3(x, -1, -1), Vec3(x, -1, 1)}, .to = {Vec3(x, 1, -1), Vec3(x, 1, 1)}};
}

const Vec3 kCube(0.04, 0.04, 0.04);

TEST(OrgansThatMeet, ABlockThatFellOnAHeldOneRestsThereWithoutJitter) {
  Block low({6, 6, 2}, {0.12, 0.12, 0.04}, Vec3::Zero(), below, kDown);
  Block high({4, 4, 4}, kCube, {0.041, 0.039, 0.06}, nowhere, kDown);
  Meeting meeting({&low, &high});
  meeting.pass(3);
  const NodeId corner = high.nearest({0.041, 0.039, 0.10});
  const Vec3 at_first = high.seen(corner);
  for (int i = 0; i < 100; ++i) {
    const Vec3 before = high.seen(corner);
    meeting.tick();
    EXPECT_LT((high.seen(corner) - before).norm(), 0.02e-3) << "a tick";
  }
  const Vec3 moved = high.seen(corner) - at_first;
  EXPECT_LT(std::abs(moved.z()), 0.05e-3) << "in a second";
  EXPECT_LT(moved.norm(), 1e-3) << "it creeps along the plate";
  EXPECT_NEAR(at_first.z(), 0.08, 0.012) << "spheres stand out by some millimetres";
}

// What the other one pushes is no load before the next step; without it a hand would be told of a fall.
TEST(OrgansThatMeet, AHandIsToldThatWhatRestsOnAnotherLiesStill) {
  Block low({6, 6, 2}, {0.12, 0.12, 0.04}, Vec3::Zero(), below, kDown);
  Block high({4, 4, 4}, kCube, {0.041, 0.039, 0.06}, nowhere, kDown);
  Meeting meeting({&low, &high});
  meeting.pass(2);
  const Vec3 top = high.seen(high.nearest({0.061, 0.059, 0.1}));
  LocalPatch patch(BodyStepper::kPatchNodes);
  for (int i = 0; i < 10; ++i) {
    meeting.tick();
    ASSERT_TRUE(high.model->local_model({0, top, 0.02}, patch));
    for (std::size_t n = 0; n < patch.node_count; ++n)
      EXPECT_LT(patch.velocities[n].norm(), 0.005) << "falling, it would be told 0.09 m/s";
  }
}

/// A cube of 10 cm, a kilogram, that is put at rest on what is held.
struct Resting {
  Block low{{6, 6, 2}, {0.12, 0.12, 0.04}, Vec3::Zero(), below, kDown};
  Block high{{5, 5, 5}, {0.1, 0.1, 0.1}, {0.01, 0.01, 0.05}, nowhere, kDown};
  NodeId corner = high.nearest({0.01, 0.01, 0.05});
};

double deepest_m(const Block& one, const Block& other) {
  double deepest_m = 0;
  for (const CollisionSphere& a : one.model->collidable())
    for (const CollisionSphere& b : other.model->collidable())
      deepest_m = std::max(deepest_m, a.radius_m + b.radius_m - (a.centre - b.centre).norm());
  return deepest_m;
}

TEST(OrgansThatMeet, WhatTouchesFromTheFirstTickRisesAndStaysNearTheSurface) {
  Resting rest;
  Meeting meeting({&rest.low, &rest.high});
  EXPECT_GT(deepest_m(rest.low, rest.high), 0.02);
  meeting.pass(1);
  EXPECT_LT(deepest_m(rest.low, rest.high), 6e-3);
  meeting.pass(1);
  EXPECT_LT(deepest_m(rest.low, rest.high), 6e-3);
}

TEST(OrgansThatMeet, AStackThatTouchesFromTheFirstTickStands) {
  Resting rest;
  Block top({4, 4, 4}, kCube, {0.04, 0.04, 0.16}, nowhere, kDown);
  Meeting meeting({&rest.low, &rest.high, &top});
  const NodeId corner = top.nearest({0.04, 0.04, 0.16});
  meeting.pass(1.5);
  const double at_first_m = top.seen(corner).z();
  EXPECT_GT(at_first_m, 0.15);
  meeting.pass(0.5);
  EXPECT_NEAR(top.seen(corner).z(), at_first_m, 0.5e-3);
}

// Two that a push moves as easily as their spheres alone, far from what lies on a block.
TEST(OrgansThatMeet, WhatOthersDoElsewhereChangesNothing) {
  Resting alone, beside;
  const Vec3 far(1, 0, 0);
  Block a({1, 1, 1}, kCube, far, nowhere, Vec3::Zero());
  Block b({1, 1, 1}, kCube, far + Vec3(0, 0, 0.03), nowhere, Vec3::Zero());
  Meeting two({&alone.low, &alone.high}), four({&beside.low, &a, &beside.high, &b});
  const Vec3 at_first = b.seen(NodeId(0));
  for (int i = 0; i < 50; ++i) {
    two.tick();
    four.tick();
    ASSERT_EQ(alone.high.seen(alone.corner), beside.high.seen(beside.corner)) << "after " << i << " ticks";
  }
  EXPECT_GT((b.seen(NodeId(0)) - at_first).norm(), 1e-3) << "they met";
}

TEST(OrgansThatMeet, ARunAfterAResetIsTheSameRun) {
  Resting rest;
  Meeting meeting({&rest.low, &rest.high});
  std::vector<Vec3> seen;
  for (int i = 0; i < 50; ++i) {
    meeting.tick();
    seen.push_back(rest.high.seen(rest.corner));
  }
  meeting.reset();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    meeting.tick();
    ASSERT_EQ(rest.high.seen(rest.corner), seen[i]) << "after " << i << " ticks";
  }
}

TEST(OrgansThatMeet, APieceThatIsCutOffFallsOnAnotherOrganAndStaysThere) {
  Block held({8, 2, 2}, {0.16, 0.04, 0.04}, {0, 0.04, 0.06}, at_the_left, kDown);
  Block plate({6, 6, 2}, {0.14, 0.12, 0.03}, {0.05, 0, 0}, below, kDown);
  Meeting meeting({&held, &plate});
  meeting.pass(0.2);
  const CutStroke stroke = stroke_at(0.07);
  meeting.tick({.presses = {}, .cuts = {&stroke, 1}});
  const auto removed = held.model->status().removed_tetrahedra;
  ASSERT_GT(removed, 0u);
  meeting.pass(3);
  EXPECT_EQ(held.model->status().removed_tetrahedra, removed) << "nothing of it fell out of reach";
  const NodeId end = held.nearest({0.14, 0.06, 0.06});
  const Vec3 at_first = held.seen(end);
  EXPECT_NEAR(at_first.z(), 0.03, 0.018) << "spheres of both stand out by up to 9 mm";
  meeting.pass(1);
  EXPECT_LT((held.seen(end) - at_first).norm(), 1e-3);
}

TEST(OrgansThatMeet, WhatIsCutAwayMeetsNobody) {
  Block block({4, 4, 4}, kCube, Vec3::Zero(), nowhere, Vec3::Zero());
  const std::size_t whole = block.model->collidable().size();
  const CutStroke stroke = stroke_at(0.02);
  block.model->step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  EXPECT_LT(block.model->collidable().size(), whole);
  EXPECT_GT(block.model->collidable().size(), whole / 2);
  block.model->reset();
  EXPECT_EQ(block.model->collidable().size(), whole);
}

TEST(OrgansThatMeet, NothingOfItTakesMemory) {
  Block low({6, 6, 2}, {0.12, 0.12, 0.04}, Vec3::Zero(), below, kDown);
  Block high({4, 4, 4}, kCube, {0.041, 0.039, 0.05}, nowhere, kDown);
  OrganCollision collision({low.model.get(), high.model.get()});
  const CutStroke stroke = stroke_at(0.06);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 40; ++i) {
    low.model->step({}, kTick_s);
    high.model->step({.presses = {}, .cuts = {&stroke, i == 20 ? 1u : 0u}}, kTick_s);
    (void)collision.run();
  }
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(high.model->status().removed_tetrahedra, 0u);
}

// One is pulled by what pulls nothing else. All nodes are of the surface: their momentum is seen, as floats.
TEST(OrgansThatMeet, TwoThatCollideInFlightHaveTheMomentumThatTheyWereGiven) {
  const Vec3 pull(0.5, 0, 0);
  Block left({3, 3, 1}, {0.04, 0.04, 0.02}, Vec3::Zero(), nowhere, pull);
  Block right({5, 4, 1}, {0.04, 0.04, 0.025}, {0.06, 0.01, 0.003}, nowhere, Vec3::Zero());
  Meeting meeting({&left, &right});
  const Vec3 right_before = right.first_moment();
  meeting.pass(0.6);
  const Vec3 before = left.first_moment() + right.first_moment();
  meeting.tick();
  const Vec3 momentum = (left.first_moment() + right.first_moment() - before) / kTick_s;
  const Vec3 given = left.mass_kg() * 0.61 * pull;
  EXPECT_LT((momentum - given).norm(), 1e-4 * given.norm()) << momentum.transpose();
  EXPECT_GT((right.first_moment() - right_before).x(), 0.001 * right.mass_kg()) << "they met";
}

}  // namespace
}  // namespace omentum::deform
