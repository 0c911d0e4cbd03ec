// Palpation: the hand that presses over the scene's nodule feels it.
#include "geometry/rotation.h"
#include "haptic_node/haptic_setup.h"
#include "tests/haptic_node/haptic_fixtures.h"
#include "tests/haptic_node/scene_session.h"
#include "tests/support/scene_organ.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace omentum::haptic_test {
namespace {

constexpr double kBed_m = -0.02;  // the scene's `fixed`: below it nothing moves

class NoduleTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!make(test::Regions::kOfTheScene)) GTEST_SKIP() << "organ_phantom is absent";
    const std::vector<double>& ball = scene_.organs.at(0).regions.at(0).ball;
    centre_ = Vec3(ball.data());
    radius_m_ = ball.at(3);
  }

  bool make(test::Regions regions) {
    if (!test::build_scene_organs("nodule", regions, folder_.path())) return false;
    scene_ = scene::load_scene(folder_ / "nodule.toml");
    return true;
  }

  static double thickness_m(const scene::HandSpec& hand) {
    return (hand.press_point[2] - kBed_m) / hand.press_normal[2];
  }
  // From the nodule's middle to the line along which the hand presses.
  double aside_m(const scene::HandSpec& hand) const {
    const Vec3 from = hand.press_point - centre_, n = hand.press_normal;
    return (from - from.dot(n) * n).norm();
  }

  // The first tool, straight into the tissue under a hand's place, slowly.
  double force_at_depth(const scene::HandSpec& hand, double depth_m) const {
    Bench bench(haptic::make_setup(scene_, 1000).model);
    const Vec3 surface = hand.press_point, n = hand.press_normal;
    bench.input().frame.q_WT = geometry::rotation_onto(Vec3::UnitZ(), n);
    bench.step_to(surface + 0.01 * n);
    return bench.move_to(surface - depth_m * n, 1000).norm();
  }

  test::ScratchFolder folder_;
  scene::Scene scene_;
  Vec3 centre_ = Vec3::Zero();
  double radius_m_ = 0;
};

TEST_F(NoduleTest, TheSamePressIsHarderOverItThanBesideItAtEqualThickness) {
  constexpr double kThinner = 0.02, kFelt = 1.6;
  const scene::HandSpec &over = scene_.hands.at(0), &beside = scene_.hands.at(1);
  ASSERT_LT(aside_m(over), radius_m_ / 2);
  ASSERT_GT(aside_m(beside), 3 * radius_m_);
  ASSERT_NEAR(thickness_m(over), thickness_m(beside), kThinner * thickness_m(over));
  for (const double depth_m : {0.003, 0.006}) {
    const double with = force_at_depth(over, depth_m), without = force_at_depth(beside, depth_m);
    std::printf("%.0f mm: %.3f N over the nodule, %.3f N beside it\n", 1e3 * depth_m, with, without);
    EXPECT_GT(with, kFelt * without) << depth_m;
  }
}

TEST_F(NoduleTest, WithoutItBothPlacesFeelAlike) {
  constexpr double kMesh = 0.2;  // what elements of 8 mm make of a tip of 4 mm
  ASSERT_TRUE(make(test::Regions::kNone));
  for (const double depth_m : {0.003, 0.006}) {
    const double there = force_at_depth(scene_.hands.at(0), depth_m);
    EXPECT_NEAR(force_at_depth(scene_.hands.at(1), depth_m), there, kMesh * there) << depth_m;
  }
}

// What the two hands of the scene tell who looks at their panel.
TEST_F(NoduleTest, TheScenesHandsFeelItWhenTheyPressEquallyFar) {
  ASSERT_EQ(scene_.hands.at(0).depth_m, scene_.hands.at(1).depth_m);
  SceneSession session(scene_, 1000);
  session.run();
  const double over = session.hand(0).report()["hold_force_n"],
               beside = session.hand(1).report()["hold_force_n"];
  std::printf("hands that yield: %.3f N over the nodule, %.3f N beside it\n", over, beside);
  EXPECT_GT(over, 1.35 * beside);
  EXPECT_TRUE(session.faults().empty());
}

}  // namespace
}  // namespace omentum::haptic_test
