#include "device_bridge/mouse_hand.h"

#include "device_bridge/glide.h"
#include "tests/device_bridge/pointer_scene.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace omentum::device {
namespace {

using test::ray_to;

constexpr double kMouseRate_hz = 1000;
constexpr std::int64_t kMousePeriod_ns = 1'000'000;
constexpr int kTicksPerRay = 33;

scene::HandSpec hovering() {
  scene::HandSpec hand;
  hand.press_point = Vec3::Zero();
  hand.press_normal = Vec3(0, -1, 0);  // towards the viewer of ray_to()
  hand.hover_m = 0.02;
  return hand;
}

scene::ToolSpec tool_with(const std::string& shape, bool cuts = false) {
  scene::ToolSpec tool;
  tool.shape = shape;
  tool.points = {Vec3::Zero()};
  if (cuts) tool.edge = {Vec3::Zero(), Vec3(0, 0, 0.01)};
  return tool;
}

/// A mouse, a window that says where it points every 33 ms, and what the tip meets.
class MouseHandTest : public testing::Test {
 protected:
  void make(const scene::ToolSpec& tool = tool_with("probe"), bool waits = true) {
    mouse_.emplace(hovering(), tool, kMouseRate_hz, rays_, waits);
    ray_ = ray_to({0, -0.02, 0});
  }
  /// `meets`: the force on the tip there, answered in the next period.
  void run(double seconds, const std::function<Vec3(const Vec3&)>& meets = {}) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * kMouseRate_hz)); ++i) {
      now_ns_ += kMousePeriod_ns;
      if (tick_++ % kTicksPerRay == 0 && says_) {
        ++ray_.seq;
        rays_.take(ray_, now_ns_);
      }
      wrench_.force = meets && now_.valid ? meets(now_.position) : Vec3::Zero();
      mouse_->command(wrench_);
      const Measurement before = now_;
      now_ = mouse_->measure(now_ns_);
      if (before.valid) {
        farthest_step_m_ = std::max(farthest_step_m_, (now_.position - before.position).norm());
        fastest_turn_rad_s_ = std::max(fastest_turn_rad_s_,
                                       kMouseRate_hz * now_.orientation.angularDistance(before.orientation));
      }
    }
  }
  static std::function<Vec3(const Vec3&)> wall(double n_m) {
    return [n_m](const Vec3& tip) { return Vec3(0, -n_m * std::max(0.0, tip.y()), 0); };
  }

  RayInbox rays_;
  std::optional<MouseHand> mouse_;
  msg::PointerRay ray_;
  bool says_ = true;
  Wrench wrench_;
  Measurement now_;
  std::int64_t now_ns_ = 1'000'000'000;
  int tick_ = 0;
  double farthest_step_m_ = 0, fastest_turn_rad_s_ = 0;
};

TEST_F(MouseHandTest, WaitsWhereItsScriptStartsUntilThePointerMoves) {
  make();
  says_ = false;
  run(5);  // the script would have pressed by now
  EXPECT_LT((now_.position - Vec3(0, -0.02, 0)).norm(), 1e-9);
  says_ = true;
  run(0.5);
  EXPECT_LT((now_.position - Vec3(0, -0.02, 0)).norm(), 1e-9);
  const auto [x, y, z] = ray_to({0.03, -0.02, 0.01}).direction;
  ray_.direction = {x, y, z};
  run(1);
  EXPECT_LT((now_.position - Vec3(0.03, -0.02, 0.01)).norm(), 1e-5);
}

TEST_F(MouseHandTest, AScriptPlaysUntilTheMouseComesAndTheTipDoesNotJumpThen) {
  make(tool_with("probe"), false);
  ray_.valid = false;
  const Vec3 start = now_.position;
  run(4.6, wall(300));  // in the middle of the script's press
  EXPECT_GT(now_.position.y(), 0.001);
  const Vec3 pressed = now_.position;
  farthest_step_m_ = 0;
  ray_.valid = true;
  run(1, wall(300));
  EXPECT_LT((now_.position - pressed).norm(), 0.001) << "it holds what the script held";
  EXPECT_LT(farthest_step_m_, 1e-4);
  EXPECT_NE(now_.position, start);
}

TEST_F(MouseHandTest, APointerThatIsThrownMovesTheTipAsAHandWould) {
  make();
  run(0.1);
  for (const Vec3& place : {Vec3(0.3, -0.02, 0), Vec3(-0.3, -0.02, 0.3), Vec3(0.2, -0.02, -0.2)}) {
    ray_.direction = ray_to(place).direction;
    run(0.4);
  }
  EXPECT_GT(farthest_step_m_, 0.5 * kFastestGlide_m_s / kMouseRate_hz) << "it did move";
  EXPECT_LT(farthest_step_m_, 1.2 * kFastestGlide_m_s / kMouseRate_hz);
}

// Of finite numbers too: one after the other may add up to none.
TEST_F(MouseHandTest, RaysBeyondAllMeaningLeaveTheHandFiniteAndTheMouseInCharge) {
  make();
  run(0.2);
  const msg::PointerRay good = ray_;
  for (const double huge : {1.7e308, -1.7e308, 1e200, -1e12}) {
    ray_.wheel = huge;
    run(0.2);
    ray_.origin.y = -std::abs(huge);
    run(0.2);
    ASSERT_TRUE(now_.position.allFinite() && now_.linear_velocity.allFinite()) << huge;
  }
  const std::uint64_t seq = ray_.seq;
  ray_ = good;
  ray_.seq = seq;
  run(3);
  const Vec3 before = now_.position;
  ray_.direction = device::to_message(Vec3(Vec3(0.1, 0.48, 0).normalized()));
  run(3);
  EXPECT_GT((now_.position - before).norm(), 0.03) << "it still follows";
  EXPECT_LT(farthest_step_m_, 1.2 * kFastestGlide_m_s / kMouseRate_hz);
}

TEST_F(MouseHandTest, PullsNoHarderThanItsSpringAndComesBackAtOnce) {
  make();
  run(0.1);
  ray_.wheel = 50;  // 20 cm deep into something hard
  run(2, wall(2000));
  // the tip still went on a little where the rest was forgotten
  EXPECT_LT(wrench_.force.norm(), kMousePull_n);
  EXPECT_GT(wrench_.force.norm(), 0.9 * kMousePull_n);
  ray_.wheel -= 2;
  run(1, wall(2000));
  // two of the 25 mm that the spring was long
  EXPECT_LT(wrench_.force.norm(), 0.75 * kMousePull_n);
}

TEST_F(MouseHandTest, ComesToRestAtWhateverItHits) {
  for (const double n_m : {50.0, 500.0, 3000.0}) {
    make();
    run(0.1);
    ray_.wheel = 8;
    run(3, wall(n_m));
    double moved = 0;
    for (int i = 0; i < 200; ++i) {
      run(0.001, wall(n_m));
      moved = std::max(moved, now_.linear_velocity.norm());
    }
    EXPECT_LT(moved, 1e-5) << n_m;
    EXPECT_GT(wrench_.force.norm(), 0.1) << n_m;
  }
}

// Passivity: from rest, what the tip gives to whatever acts on it is never more than what it got before.
TEST_F(MouseHandTest, GivesNoEnergyOfItsOwnWhileThePointerRests) {
  make();
  run(0.1);
  std::mt19937 random(3);
  std::normal_distribution<double> any_n(0, 8);  // at times beyond the spring's end
  double given_j = 0, most_given_j = 0, got_j = 0;
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    if (i % 40 == 0) force = {any_n(random), any_n(random), any_n(random)};
    const Vec3 before = now_.position;
    run(0.001, [&](const Vec3&) { return force; });
    const double work_j = wrench_.force.dot(now_.position - before);
    got_j += std::max(0.0, work_j);
    given_j -= work_j;
    most_given_j = std::max(most_given_j, given_j);
  }
  EXPECT_GT(got_j, 0.1);
  EXPECT_LT(most_given_j, 1e-9);
}

TEST_F(MouseHandTest, SilentRaysStopTheCutAndLeaveTheRest) {
  make(tool_with("grasper", true));
  ray_.buttons = msg::POINTER_LEFT | msg::POINTER_RIGHT;
  run(0.2);
  EXPECT_EQ(now_.buttons, msg::BUTTON_CUT);
  ray_.direction = ray_to({0.02, -0.02, 0}).direction;
  run(0.4);
  says_ = false;
  run(1);
  EXPECT_EQ(now_.buttons, 0U);
  EXPECT_TRUE(now_.valid);
  const Measurement silent = now_;
  run(3);
  EXPECT_EQ(now_.grip, silent.grip);
  EXPECT_LT((now_.position - silent.position).norm(), 1e-9);
}

TEST_F(MouseHandTest, JawsStayAsTheyWereLeftUntilTheButtonIsPressedAnew) {
  make(tool_with("grasper"));
  run(0.2);
  ray_.buttons = msg::POINTER_RIGHT;
  run(0.1);
  ray_.buttons = 0;
  run(1);
  EXPECT_DOUBLE_EQ(now_.grip, kJawsOpen_rad);
  ray_.buttons = msg::POINTER_RIGHT;
  run(1);
  EXPECT_EQ(now_.grip, 0);
  ray_.valid = false;  // the mouse is another tool's now
  run(0.1);
  ray_.buttons = 0;
  run(1);
  EXPECT_EQ(now_.grip, 0);
  ray_.valid = true;
  run(1);
  EXPECT_EQ(now_.grip, 0);
  ray_.keys = msg::POINTER_KEY_CLOSE;
  run(0.1);
  ray_.keys = 0;
  run(0.2);
  EXPECT_NEAR(now_.grip, 0.2 * kJawRate_rad_s, 0.04);
}

TEST_F(MouseHandTest, TheLeftButtonDoesWhatTheToolIsFor) {
  make(tool_with("probe", true));
  ray_.buttons = msg::POINTER_LEFT;
  run(0.1);
  EXPECT_EQ(now_.buttons, msg::BUTTON_CUT);
  make(tool_with("probe"));
  run(0.1);
  EXPECT_EQ(now_.buttons, 0U);
  make(tool_with("grasper"));
  ray_.buttons = msg::POINTER_LEFT;
  run(0.1);
  ray_.buttons = 0;
  run(0.2);
  const double open = now_.grip;
  ray_.buttons = msg::POINTER_LEFT;
  run(0.1);
  EXPECT_LT(now_.grip, open);
  EXPECT_EQ(now_.buttons, 0U);
}

TEST_F(MouseHandTest, TheShaftGoesThroughItsTrocarAndTheTipIsNotDrawnOut) {
  scene::ToolSpec tool = tool_with("probe");
  tool.trocar = Vec3(0.05, -0.2, 0.1);
  make(tool);
  run(0.1);
  ray_.wheel = -100;  // 40 cm towards the viewer
  run(3);
  EXPECT_GT((now_.position - *tool.trocar).norm(), 0.99 * kLeastInsertion_m);
  EXPECT_LT(fastest_turn_rad_s_, 30);
  ray_.wheel = 0;
  ray_.keys = msg::POINTER_KEY_ROLL_RIGHT;
  run(2);
  const Vec3 shaft = (*tool.trocar - now_.position).normalized();
  EXPECT_LT((now_.orientation * Vec3::UnitZ() - shaft).norm(), 1e-9);
  ray_.wheel = 400;
  run(5);
  EXPECT_LT((now_.position - *tool.trocar).norm(), tool.shaft_length_m);
}

TEST_F(MouseHandTest, WithoutATrocarThePointerTiltsTheShaftAboutTheTip) {
  make();
  run(0.1);
  const Measurement upright = now_;
  ray_.keys = msg::POINTER_KEY_TILT;
  ray_.direction = ray_to({0.06, -0.02, 0}).direction;
  run(1);
  EXPECT_LT((now_.position - upright.position).norm(), 1e-9);
  EXPECT_NEAR(now_.orientation.angularDistance(upright.orientation), kTiltPerTangent * 0.06 / 0.48, 1e-9);
  EXPECT_GT((now_.orientation * Vec3::UnitZ()).x(), 0.1);
  EXPECT_LT(fastest_turn_rad_s_, 1.01 * kMouseTurn_rad_s);
}

TEST_F(MouseHandTest, APauseIsNoMotionAndAResetGoesHome) {
  make();
  run(0.1);
  mouse_->pause(true);
  ray_.direction = ray_to({0.05, -0.02, 0}).direction;
  run(0.2);
  mouse_->pause(false);
  run(0.5);
  EXPECT_LT((now_.position - Vec3(0, -0.02, 0)).norm(), 1e-9);
  ray_.direction = ray_to({0, -0.02, 0.05}).direction;
  run(1);
  EXPECT_GT(now_.position.z(), 0.03);
  says_ = false;
  mouse_->restart();
  run(2);
  EXPECT_LT((now_.position - Vec3(0, -0.02, 0)).norm(), 1e-5);
}

TEST_F(MouseHandTest, TakesNothingFromTheHeapAndSaysWhatWasFelt) {
  make();
  run(0.1);
  ray_.wheel = 10;
  const std::function<Vec3(const Vec3&)> meets = wall(100);
  const std::size_t before = test::heap_allocations();
  run(1, meets);
  EXPECT_EQ(test::heap_allocations(), before);
  const nlohmann::json report = mouse_->report();
  EXPECT_GT(report["peak_force_n"].get<double>(), 0.5);
  EXPECT_GT(report["rays"].get<int>(), 30);
}

}  // namespace
}  // namespace omentum::device
