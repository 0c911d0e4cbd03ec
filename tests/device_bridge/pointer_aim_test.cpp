#include "device_bridge/pointer_aim.h"

#include "tests/device_bridge/pointer_scene.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::device {
namespace {

using test::ray_to;

constexpr double kAimExact_m = 1e-12;  // of sums of a few products of lengths below a metre
constexpr std::int64_t kFrame_ns = 33'000'000;

class PointerAimTest : public testing::Test {
 protected:
  PointerAimTest() { aim_.start(Vec3::Zero()); }

  void take(msg::PointerRay ray, std::int64_t after_ns = kFrame_ns) {
    now_ns_ += after_ns;
    ray.seq = ++seq_;
    aim_.take(ray, now_ns_);
  }
  void expect_wanted(const Vec3& place) {
    EXPECT_LT((aim_.wanted() - place).norm(), kAimExact_m) << aim_.wanted().transpose();
  }

  PointerAim aim_;
  std::int64_t now_ns_ = 1'000'000'000;
  std::uint64_t seq_ = 0;
};

TEST_F(PointerAimTest, TheTipStaysUnderAPointerThatMovesFromIt) {
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.03, 0, 0), Vec3(0.03, 0, 0.07), Vec3(-0.1, 0, -0.02)}) {
    take(ray_to(place));
    expect_wanted(place);
  }
}

TEST_F(PointerAimTest, WhereThePointerBeginsMovesNothing) {
  take(ray_to({0.2, 0, 0.1}));
  expect_wanted(Vec3::Zero());
  take(ray_to({0.2, 0, 0.1}));
  expect_wanted(Vec3::Zero());
}

TEST_F(PointerAimTest, TheTipComesBackUnderThePointerWhileThatMoves) {
  take(ray_to({0.1, 0, 0}));
  double apart = 0.1;
  for (int i = 1; i <= 20; ++i) {
    take(ray_to({0.1, 0, 0.02 * (i % 2)}));
    const Vec3 under(0.1, 0, 0.02 * (i % 2));
    const double now_apart = (aim_.wanted() - under).norm();
    EXPECT_NEAR(now_apart, std::max(0.0, apart - kCatchUp * 0.02), kAimExact_m) << i;
    apart = now_apart;
  }
  EXPECT_LT(apart, kAimExact_m);
}

TEST_F(PointerAimTest, WheelAndKeysMoveAlongTheRay) {
  msg::PointerRay ray = ray_to({0, 0, 0});
  take(ray);
  ray.wheel = 3;
  take(ray);
  expect_wanted({0, 3 * kWheelStep_m, 0});
  ray.keys = msg::POINTER_KEY_NEAR;
  take(ray);
  expect_wanted({0, 3 * kWheelStep_m - kKeyDepth_m_s * 0.033, 0});
  ray.keys = msg::POINTER_KEY_ROLL_LEFT;
  take(ray);
  EXPECT_NEAR(aim_.roll(), kKeyRoll_rad_s * 0.033, kAimExact_m);
}

TEST_F(PointerAimTest, AfterASilenceAnInvalidRayOrAnotherWindowItBeginsAnew) {
  msg::PointerRay ray = ray_to({0, 0, 0});
  take(ray);
  ray = ray_to({0.05, 0, 0});
  ray.wheel = 9;
  take(ray, 2'100'000'000);
  expect_wanted(Vec3::Zero());

  ray.valid = false;
  take(ray);
  EXPECT_EQ(aim_.ray(now_ns_), nullptr);
  ray = ray_to({-0.05, 0, 0});
  take(ray);
  expect_wanted(Vec3::Zero());

  seq_ = 0;  // a window that was opened again counts from one, and its wheel from zero
  ray.wheel = 0;
  take(ray);
  expect_wanted(Vec3::Zero());
}

TEST_F(PointerAimTest, AWindowThatIsSlowIsFollowedButHoldsNothingDownForLong) {
  msg::PointerRay ray = ray_to({0, 0, 0});
  ray.keys = msg::POINTER_KEY_AWAY;
  take(ray);
  EXPECT_NE(aim_.ray(now_ns_ + 400'000'000), nullptr);
  EXPECT_EQ(aim_.ray(now_ns_ + 600'000'000), nullptr);
  ray = ray_to({0.1, 0, 0});
  take(ray, 1'500'000'000);
  expect_wanted({0.1, 0, 0});
  ray.keys = msg::POINTER_KEY_AWAY;
  take(ray, 1'500'000'000);
  EXPECT_NEAR((aim_.wanted() - Vec3(0.1, 0, 0)).norm(), kKeyDepth_m_s * kRaysSilent_s, kAimExact_m);
}

TEST_F(PointerAimTest, ACameraThatMovesCarriesNothingAlong) {
  take(ray_to({0, 0, 0}));
  take(ray_to({0.1, 0, 0.1}, {0.1, -0.5, 0.1}));  // the same place of the picture
  expect_wanted(Vec3::Zero());
}

TEST_F(PointerAimTest, ThePointerTurnsTheShaftWhileTheKeyIsHeld) {
  msg::PointerRay ray = ray_to({0, 0, 0});
  take(ray);
  ray = ray_to({0.05, 0, 0});  // a tenth of the way to it
  ray.keys = msg::POINTER_KEY_TILT;
  take(ray);
  expect_wanted(Vec3::Zero());
  const Vec3 tilt = aim_.take_tilt();
  EXPECT_LT((tilt - Vec3(0, 0, 0.1 * kTiltPerTangent)).norm(), kAimExact_m);
  // a handle that stands towards the viewer goes to the right with it
  EXPECT_GT(tilt.cross(Vec3(0, -1, 0)).x(), 0);
  EXPECT_EQ(aim_.take_tilt(), Vec3::Zero());
}

TEST_F(PointerAimTest, WhatIsNoRayIsIgnored) {
  take(ray_to({0, 0, 0}));
  msg::PointerRay infinite = ray_to({0.1, 0, 0});
  infinite.wheel = std::numeric_limits<double>::infinity();
  msg::PointerRay nan = ray_to({0.1, 0, 0});
  nan.direction.x = std::numeric_limits<double>::quiet_NaN();
  msg::PointerRay longer = ray_to({0.1, 0, 0});
  longer.up.z = 1.1;
  msg::PointerRay backwards = ray_to({0.1, 0, 0});
  backwards.right = {-1, 0, 0};
  for (const msg::PointerRay& ray : {infinite, nan, longer, backwards}) {
    EXPECT_FALSE(is_ray(ray));
    take(ray);
    expect_wanted(Vec3::Zero());
  }
  take(ray_to({0.1, 0, 0}));  // of the last one that was
  expect_wanted({0.1, 0, 0});
}

TEST_F(PointerAimTest, WhatIsGivenUpIsWantedNoMore) {
  aim_.correct({0.1, 0.2, 0});
  aim_.give_up_beyond({0, 0.05, 0}, Vec3::UnitY());
  expect_wanted({0.1, 0.05, 0});
  aim_.give_up_beyond({0, 0.06, 0}, Vec3::UnitY());
  expect_wanted({0.1, 0.05, 0});
}

}  // namespace
}  // namespace omentum::device
