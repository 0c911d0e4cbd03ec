// An intestine among other organs, by the real models.
#include "tests/deform_node/deform_fixtures.h"
#include "tests/deform_node/gut_stage.h"
#include "tests/deform_node/tissue_block.h"

#include "deform_node/organ_collision.h"
#include "deform_node/quasi_static_model.h"
#include "tests/support/heap_count.h"

namespace omentum::deform {
namespace {

/// Below the highest part of the loops.
constexpr std::array kCells{8, 7, 2};
const Vec3 kSize(0.24, 0.24, 0.03), kCorner(-0.12, -0.12, 0.03);

/// So thin that its loops do not touch each other: what moves is what organs do.
const geometry::GutShape& thin_gut() {
  static const geometry::GutShape shape = [] {
    geometry::GutAnatomy anatomy;
    anatomy.length_m = 1.6;
    anatomy.legs = 3;
    anatomy.columns = 40;
    anatomy.tube_radius_m = 0.008;
    anatomy.mesentery_thickness_m = 0.001;
    return geometry::make_gut(anatomy);
  }();
  return shape;
}

GutModel heavy_gut() {
  const auto make = [] {
    physics::GutStepSettings step;
    step.step_s = kGutTick_s;
    return std::make_unique<physics::GutSystem>(thin_gut(), physics::GutMaterial(),
                                                physics::GutCollisionSettings(), step);
  };
  return GutModel({.system = make(), .felt = make()});
}

/// The same box, precomputed.
struct StillBlock {
  geometry::TetraMesh mesh = test::make_box_mesh(kCells[0], kCells[1], kCells[2], kSize);
  geometry::Surface surface = geometry::extract_surface(mesh, {});
  std::vector<Vec3> rest;
  physics::SurfaceCompliance compliance = deform_test::random_compliance(surface.mobile_count, 11);
  std::unique_ptr<QuasiStaticModel> model;

  StillBlock() {
    for (Vec3& x : mesh.positions) x += kCorner;
    rest = geometry::surface_positions(mesh, surface);
    model = std::make_unique<QuasiStaticModel>(compliance, surface, rest,
                                               geometry::cover_with_spheres(mesh, surface));
  }
};

std::vector<Vec3> masses(const OrganModel& gut) {
  std::vector<Vec3> x;
  const auto values = gut.view().values;
  for (std::size_t i = 0; i < values.size(); i += 3) x.emplace_back(values[i], values[i + 1], values[i + 2]);
  return x;
}

/// The gut's highest mass that is not held, at the start.
std::size_t top() {
  const auto& x = small_gut().positions;
  return static_cast<std::size_t>(std::ranges::max_element(x, {}, [](const Vec3& p) { return p.z(); }) -
                                  x.begin());
}

/// Masses of the axis that lie on the block, not beside it.
std::vector<std::size_t> lying(const std::vector<Vec3>& x) {
  std::vector<std::size_t> on;
  const double half_m = kSize.x() / 2 - 0.02, above_m = kCorner.z() + kSize.z();
  for (std::size_t m = 0; m < static_cast<std::size_t>(thin_gut().layout.columns); ++m)
    if (std::abs(x[m].x()) < half_m && std::abs(x[m].y()) < half_m && x[m].z() > above_m) on.push_back(m);
  return on;
}

/// Falls, and stays on top. What hangs down beside the block may still pull it along, slowly.
void expect_rest_on(OrganModel& block) {
  GutModel gut = heavy_gut();
  OrganCollision collision({&gut, &block});
  const auto tick = [&] {
    gut.step({}, kGutTick_s);
    block.step({}, kGutTick_s);
    EXPECT_TRUE(collision.run());
    EXPECT_FALSE(gut.status().diverged || block.status().diverged);
    return masses(gut);
  };
  for (int i = 0; i < 200; ++i) tick();
  std::vector<Vec3> before = tick(), now = tick();
  EXPECT_GE(lying(now).size(), 8u);
  double trembles_m = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<Vec3> next = tick();
    for (const std::size_t m : lying(next))
      trembles_m = std::max(trembles_m, (next[m] - 2 * now[m] + before[m]).norm());
    before = std::exchange(now, next);
  }
  EXPECT_LT(trembles_m, 0.2e-3) << "a tick, beside what moves on steadily";
  EXPECT_GE(lying(now).size(), 8u);
  double lowest_m = 1;
  for (const std::size_t m : lying(now)) lowest_m = std::min(lowest_m, now[m].z());
  EXPECT_GT(lowest_m, kCorner.z() + kSize.z() + thin_gut().tube_radius_m - 2e-3) << "it sank in";
}

TEST(GutMeets, ALoopThatFallsOnABlockWithMassesRestsThere) {
  Block block(kCells, kSize, kCorner, below, kDown);
  expect_rest_on(*block.model);
}

TEST(GutMeets, ALoopThatFallsOnAPrecomputedBlockRestsThere) {
  StillBlock block;
  expect_rest_on(*block.model);
}

TEST(GutMeets, WithoutABlockTheLoopWouldFallDeeper) {
  GutModel gut = gut_model({.gravity_m_s2 = kDown});
  for (int i = 0; i < 500; ++i) gut.step({}, kGutTick_s);
  EXPECT_LT(masses(gut)[top()].z(), kCorner.z() + kSize.z());
}

/// By what is seen, as floats.
Vec3 first_moment(const OrganModel& gut, std::span<const double> masses_kg) {
  const std::vector<Vec3> x = masses(gut);
  Vec3 sum = Vec3::Zero();
  for (std::size_t m = 0; m < x.size(); ++m) sum += masses_kg[m] * x[m];
  return sum;
}

// In its first explicit step nothing reaches the vessel, which is held.
TEST(GutMeets, WhatPartsABlockFromALoopGivesBothTheSameMomentum) {
  const double step_s = 5e-5;
  GutModel gut = gut_model({.step_s = step_s, .method = physics::GutMethod::kExplicit});
  Block block({2, 2, 1}, {0.04, 0.04, 0.02}, {-0.02, -0.02, 0.165}, nowhere, Vec3::Zero(), step_s);
  const physics::GutSprings springs(small_gut(), physics::GutMaterial());
  OrganCollision collision({&gut, block.model.get()});
  const auto step = [&] {
    gut.step({}, step_s);
    block.model->step({}, step_s);
  };
  step();
  EXPECT_TRUE(collision.run());
  const Vec3 gut_before = first_moment(gut, springs.mass()), block_before = block.first_moment();
  step();
  const Vec3 of_gut = (first_moment(gut, springs.mass()) - gut_before) / step_s;
  const Vec3 of_block = (block.first_moment() - block_before) / step_s;
  EXPECT_LT(of_gut.z(), -1e-3) << "kg m/s: they lie in one another";
  EXPECT_LT((of_gut + of_block).norm(), 0.03 * of_gut.norm()) << of_gut.transpose();
}

TEST(GutMeets, NothingOfItTakesMemory) {
  Block block(kCells, kSize, kCorner + Vec3(0, 0, 0.045), below, kDown);
  GutModel gut = gut_model({.gravity_m_s2 = kDown});
  OrganCollision collision({&gut, block.model.get()});
  LocalPatch patch(GutModel::kPatchNodes);
  const Vec3 begin = small_gut().positions[top()];
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 20; ++i) {
    gut.step({}, kGutTick_s);
    block.model->step({}, kGutTick_s);
    (void)collision.run();
    (void)gut.local_model({0, begin, 0.02}, patch);
  }
  gut.reset();
  EXPECT_EQ(test::heap_allocations(), before);
}

/// Two of the small gut side by side, so near that their outermost loops are `deep_m` in one another.
struct TwoGuts {
  TwoGuts(double deep_m, physics::GutStepSettings step)
      : low_y(gut_at(0, step)), high_y(gut_at(way(deep_m), step)) {}

  static double way(double deep_m) {
    const auto by_y = [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); };
    const auto [least, most] = std::ranges::minmax_element(small_gut().positions, by_y);
    return most->y() - least->y() + 2 * small_gut().tube_radius_m - deep_m;
  }
  static GutModel gut_at(double y, const physics::GutStepSettings& step) {
    geometry::GutShape shape = small_gut();
    for (Vec3& x : shape.positions) x.y() += y;
    physics::GutStepSettings felt = step;
    felt.method = physics::GutMethod::kProjective;
    felt.step_s = std::max(step.step_s, kGutTick_s);
    const auto make = [&](const physics::GutStepSettings& settings) {
      return std::make_unique<physics::GutSystem>(shape, physics::GutMaterial(),
                                                  physics::GutCollisionSettings(), settings);
    };
    const physics::GutObstacle floor{.centre = Vec3(0, 0, -0.12)};
    return GutModel({.system = make(step), .felt = make(felt), .obstacles = {floor}});
  }
  void tick(double seconds = kGutTick_s) {
    for (GutModel* gut : {&low_y, &high_y}) gut->step({}, seconds);
    EXPECT_TRUE(collision.run());
  }
  /// Between both axes, where they are free.
  double nearest_m() const {
    double least_m = 1;
    for (const double gap_m : gaps_m()) least_m = std::min(least_m, gap_m);
    return least_m;
  }
  /// Of low_y's axis, where the other is nearest.
  Vec3 nearest_place() const {
    const std::vector<double> gap_m = gaps_m();
    return masses(low_y)[static_cast<std::size_t>(std::ranges::min_element(gap_m) - gap_m.begin())];
  }
  /// From each free mass of low_y's axis to the other axis; 1 m at its held ends.
  std::vector<double> gaps_m() const {
    const auto axis = static_cast<std::size_t>(small_gut().layout.columns);
    const std::vector<Vec3> one = masses(low_y), other = masses(high_y);
    std::vector<double> gap_m(axis, 1.0);
    for (std::size_t i = 1; i + 1 < axis; ++i)
      for (std::size_t j = 1; j + 1 < axis; ++j) gap_m[i] = std::min(gap_m[i], (one[i] - other[j]).norm());
    return gap_m;
  }

  GutModel low_y, high_y;
  OrganCollision collision{{&low_y, &high_y}};
};

TEST(GutsMeet, WhatFellBesideAnotherRestsWithoutLyingInIt) {
  TwoGuts guts(-0.002, {.step_s = kGutTick_s});
  const double touching_m = 2 * small_gut().tube_radius_m;
  double nearest_m = 1;
  for (int i = 0; i < 600; ++i) {
    guts.tick();
    nearest_m = std::min(nearest_m, guts.nearest_m());
  }
  EXPECT_LT(nearest_m, touching_m) << "they touched";
  EXPECT_GT(nearest_m, touching_m - 0.015) << "at its deepest, as they fall; 35 mm if they did not meet";
  const std::vector<Vec3> before = masses(guts.low_y);
  guts.tick();
  const std::vector<Vec3> after = masses(guts.low_y);
  double way_m = 0;
  for (std::size_t m = 0; m < after.size(); ++m)
    way_m += (after[m] - before[m]).norm() / static_cast<double>(after.size());
  EXPECT_LT(way_m, 0.02e-3) << "a tick";
}

// In its first explicit steps nothing reaches the vessel, which is held.
TEST(GutsMeet, PushesAreOppositeAndEqualFromTheFirstToThoseThatGoOn) {
  const double step_s = 5e-5;
  TwoGuts guts(0.01,
               {.method = physics::GutMethod::kExplicit, .step_s = step_s, .gravity_m_s2 = Vec3::Zero()});
  const physics::GutSprings springs(small_gut(), physics::GutMaterial());
  guts.tick(step_s);
  const Vec3 one = first_moment(guts.low_y, springs.mass()),
             other = first_moment(guts.high_y, springs.mass());
  for (int i = 0; i < 3; ++i) guts.tick(step_s);
  const Vec3 of_one = first_moment(guts.low_y, springs.mass()) - one;
  const Vec3 of_other = first_moment(guts.high_y, springs.mass()) - other;
  EXPECT_LT(of_one.y(), 0);
  EXPECT_GT(of_other.y(), 0) << "they part";
  EXPECT_LT((of_one + of_other).norm(), 0.03 * of_one.norm()) << of_one.transpose();
}

// What the other one pushes is no load before the next step; without it a hand would be told of a fall.
TEST(GutsMeet, AHandIsToldWhereOneThatLiesAtAnotherGoesNext) {
  TwoGuts guts(-0.002, {.step_s = kGutTick_s});
  for (int i = 0; i < 600; ++i) guts.tick();
  LocalPatch patch(GutModel::kPatchNodes);
  double off_m_s = 0, count = 0;
  for (int i = 0; i < 20; ++i) {
    guts.tick();
    ASSERT_TRUE(guts.low_y.local_model({0, guts.nearest_place(), 0.02}, patch));
    const std::vector<Vec3> before = skin_places(guts.low_y);
    guts.tick();
    const std::vector<Vec3> after = skin_places(guts.low_y);
    for (std::size_t n = 0; n < patch.node_count; ++n, ++count) {
      const Vec3 happened = (after[patch.nodes[n]] - before[patch.nodes[n]]) / kGutTick_s;
      off_m_s += (patch.velocities[n] - happened).norm();
    }
  }
  EXPECT_LT(off_m_s / count, 0.005) << "on the average";
}

// A gut steps less often than the loop ticks: what it is to be pushed in a step does not grow by waiting for
// it.
TEST(GutsMeet, TicksBetweenTheirStepsChangeNothing) {
  const physics::GutStepSettings step{.step_s = kGutTick_s};
  TwoGuts once(0.01, step), often(0.01, step);
  once.tick(0);  // they meet before their first step
  for (int i = 0; i < 20; ++i) {
    once.tick();
    for (int part = 0; part < 4; ++part) often.tick(kGutTick_s / 4);
  }
  double apart_m = 0;
  const std::vector<Vec3> x = masses(once.high_y), other = masses(often.high_y);
  for (std::size_t m = 0; m < x.size(); ++m) apart_m = std::max(apart_m, (x[m] - other[m]).norm());
  EXPECT_LT(apart_m, 1e-6);
}

TEST(GutsMeet, AfterAResetTheSameRunComesAgain) {
  TwoGuts guts(0.01, {.step_s = kGutTick_s});
  const auto run = [&] {
    for (int i = 0; i < 30; ++i) guts.tick();
    return masses(guts.high_y);
  };
  const std::vector<Vec3> first = run();
  for (std::size_t organ : {0U, 1U}) guts.collision.reset(organ);
  guts.low_y.reset();
  guts.high_y.reset();
  EXPECT_EQ(run(), first);
}

TEST(GutsMeet, TakesNoMemory) {
  TwoGuts guts(0.01, {.step_s = kGutTick_s});
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 10; ++i) guts.tick();
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::deform
