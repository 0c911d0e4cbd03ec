#include "deform_node/quasi_static_model.h"
#include "deform_node/state_blocks.h"

#include "tests/deform_node/deform_fixtures.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using deform_test::contact_on;
using deform_test::kNs_per_s;
using deform_test::odd_numbers;
using deform_test::random_compliance;

constexpr std::int32_t kMobile = 53;  // not a multiple of a cluster
constexpr std::int32_t kSurfaceNodes = 60;
/// The tensors are floats; a sum of a dozen products of them keeps 1e-5 of its largest term.
constexpr double kFloatSum = 1e-5;

class QuasiStaticModelTest : public ::testing::Test {
 protected:
  physics::SurfaceCompliance compliance_ = random_compliance(kMobile, 11);
  const geometry::Surface surface_ = deform_test::odd_surface(kSurfaceNodes);
  const std::vector<Vec3> rest_{std::size_t{kSurfaceNodes}, Vec3::Zero()};
  QuasiStaticModel model_{compliance_, surface_, rest_};
  runtime::FaultList faults_;
  ContactBook book_{
      {odd_numbers(kSurfaceNodes, kSurfaceNodes - kMobile)}, {.tools = 3, .max_force_n = 10}, faults_};

  /// Two tools, seven nodes, one of them touched by both.
  void press() {
    book_.take(contact_on(0, {3, 17, 50, 52}, {{0, 0, -1}, {0.5, 0, -2}, {1, 2, 3}, {-1, 0, 0.25}}),
               kNs_per_s);
    book_.take(contact_on(1, {17, 0, 31}, {{0, 1, 0}, {2, 0, -1}, {0, -3, 0.5}}), kNs_per_s);
    book_.advance(kNs_per_s);
  }
  Vec3 displacement(std::int32_t n) const {
    const auto u = model_.view().values.subspan(3 * static_cast<std::size_t>(n), 3);
    return {u[0], u[1], u[2]};
  }
  double largest() const {
    double value = 0;
    for (const float u : model_.view().values) value = std::max(value, std::abs(static_cast<double>(u)));
    return value;
  }
};

TEST_F(QuasiStaticModelTest, SuperpositionEqualsThePlainSumOfAllTools) {
  press();
  const auto loads = book_.loads(0);
  model_.step({.presses = loads, .cuts = {}}, 0.01);
  const double tolerance = kFloatSum * largest();
  for (std::int32_t n = 0; n < kSurfaceNodes; ++n) {
    Vec3 plain = Vec3::Zero();
    for (const ToolLoad& load : loads)
      for (std::size_t l = 0; l < load.nodes.size(); ++l)
        plain += compliance_.block(SurfaceId(n), surface_.of_node[load.nodes[l]]) * load.forces[l];
    EXPECT_LE((displacement(n) - plain).cwiseAbs().maxCoeff(), tolerance) << "node " << n;
    const bool moved = displacement(n) != Vec3::Zero();
    EXPECT_FALSE(n >= kMobile && moved) << "pinned node " << n;
  }
}

TEST_F(QuasiStaticModelTest, ReleaseAndResetBringTheOrganBackToRest) {
  press();
  model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  ASSERT_GT(largest(), 0);
  model_.reset();
  EXPECT_EQ(largest(), 0);
  model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  ASSERT_GT(largest(), 0);
  book_.advance(kNs_per_s + static_cast<std::int64_t>((kContactStale_s + kContactFade_s) * kNs_per_s));
  model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  EXPECT_EQ(largest(), 0) << "haptic_node fell silent";
}

TEST_F(QuasiStaticModelTest, ItsSpheresFollowTheSurfaceAboveThemAndDoNotYield) {
  geometry::Surface surface = surface_;
  surface.triangles = {{SurfaceId(3), SurfaceId(17), SurfaceId(50)}};
  const Vec3 rest(1, 2, 3), place(0.5, 0.25, 0.25);
  const geometry::CoverSphere sphere{
      .centre = rest, .radius_m = 0.5, .below = geometry::TriangleId(0), .place = place};
  QuasiStaticModel model(compliance_, surface, rest_, {.spheres = {sphere}, .spacing_m = 0.5});
  EXPECT_EQ(model.sizes().spheres, 1u);
  press();
  model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  model.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  const Vec3 u = place[0] * displacement(3) + place[1] * displacement(17) + place[2] * displacement(50);
  EXPECT_LT((model.collidable()[0].centre - rest - u).norm(), 1e-12);
  EXPECT_LT((model.collidable()[0].velocity - u / 0.01).norm(), 1e-9);
  EXPECT_TRUE(std::isinf(model.collidable()[0].mass_kg));
  model.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  EXPECT_LT(model.collidable()[0].velocity.norm(), 1e-9) << "it holds still";
  model.reset();
  EXPECT_EQ(model.collidable()[0].centre, rest);
  EXPECT_EQ(model.collidable()[0].velocity, Vec3::Zero()) << "a reset throws nothing";
}

TEST_F(QuasiStaticModelTest, StepTakesNoMemory) {
  press();
  model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  const std::size_t before = test::heap_allocations();
  for (int tick = 0; tick < 100; ++tick) {
    book_.advance(kNs_per_s + tick);
    model_.step({.presses = book_.loads(0), .cuts = {}}, 0.01);
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

TEST(StateBlocks, CoverEachNodeOnceInOrder) {
  for (const std::int32_t nodes : {1, 5, 84, 85, 1577, 26000})
    for (const auto profile : {transport::Profile::kLoopback, transport::Profile::kLan}) {
      std::int32_t next = 0;
      for (const StateBlock& block : split_state(nodes, nodes_per_block(profile))) {
        EXPECT_EQ(block.first, next);
        EXPECT_GT(block.count, 0);
        next += block.count;
      }
      EXPECT_EQ(next, nodes);
    }
}

TEST(StateBlocks, LoopbackSendsOneBlockAndLanDatagrams) {
  EXPECT_EQ(split_state(26000, nodes_per_block(transport::Profile::kLoopback)).size(), 1U);
  EXPECT_LT(nodes_per_block(transport::Profile::kLan) * 12, 1300)
      << "values alone must leave room for headers";
  EXPECT_EQ(split_state(0, 10).size(), 1U) << "an empty state is still a state";
}

}  // namespace
}  // namespace omentum::deform
