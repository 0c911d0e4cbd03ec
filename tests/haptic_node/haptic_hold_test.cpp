// What jaws hold while their hand is not heard of for a moment, and what the hand feels of it.
#include "haptic_fixtures.h"
#include "haptic_node/tool_line.h"

#include <Eigen/Geometry>

namespace omentum::haptic_test {
namespace {

constexpr std::int64_t kHoldTick_ns = 1'000'000;
constexpr double kHoldTick_s = 1e-3;
constexpr double kHoldSlew_n = haptic::ForceLimits{}.max_slew_n_s * kHoldTick_s * (1 + 1e-9);

haptic::ToolModel holding_jaws() {
  haptic::ToolModel tool;
  tool.grasps = true;
  for (const double x : {-5e-4, 5e-4})
    for (const double y : {-0.002, 0.002})
      for (const double z : {0.0, 0.006}) tool.points.emplace_back(x, y, z);
  return tool;
}

/// A flap that is held at its lower edge and grasped at the upper one, by a device that is heard at 1 kHz.
class MomentaryHold : public testing::Test {
 protected:
  static const TestOrgan& flap() {
    static const TestOrgan organ = make_organ(test::make_box_mesh(3, 10, 12, {0.008, 0.04, 0.06}),
                                              [](const Vec3& p) { return p.z() < 1e-9; });
    return organ;
  }
  static constexpr double kOpen_rad = 0.5, kShut_rad = 0.02;

  void SetUp() override {
    go_to(above_, kOpen_rad, 20);
    go_to(low_, kOpen_rad, 200);
    go_to(low_, kShut_rad, 300);
    go_to(pulled_, kShut_rad, 200);
    rest_for(300);
    held_n_ = felt_n();
    ASSERT_GT(held_n_, 0.1);
    ASSERT_TRUE(jaws().grasping);
  }

  void go_to(const Vec3& tip, double grip, int ticks) {
    const Vec3 from = tip_;
    const double grip_from = grip_;
    for (int i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      tip_ = heard_ == 0 ? tip : Vec3(from + share * (tip - from));
      grip_ = grip_from + share * (grip - grip_from);
      hear();
      tick();
    }
  }
  void rest_for(int ticks) { go_to(tip_, grip_, ticks); }
  void be_silent(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }

  void jump(const Vec3& way) { tip_ += way; }
  double bench_account_j() { return bench_.state().energies[0].account_j; }
  double felt_n() const { return felt_.norm(); }
  const haptic::ToolState& jaws() { return bench_.state().tools[0]; }

  const Vec3 above_{0.004, 0.02, 0.065}, low_{0.004, 0.02, 0.055}, pulled_{0.004, 0.02, 0.065};
  double held_n_ = 0, largest_step_n_ = 0;

 private:
  void hear() {
    msg::ToolPose pose{};
    pose.seq = ++heard_;
    pose.stamp_ns = now_ns_ + kHoldTick_ns;
    pose.valid = true;
    pose.position = {.x = tip_.x(), .y = tip_.y(), .z = tip_.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    pose.grip = grip_;
    line_.hear(pose, now_ns_ + kHoldTick_ns);
  }
  void tick() {
    now_ns_ += kHoldTick_ns;
    line_.listen(now_ns_, bench_.input());
    bench_.step();
    const msg::ToolForce& answer = line_.answer(bench_.output(), now_ns_, kHoldTick_s, false);
    line_.sent(true);
    const Vec3 before = felt_;
    felt_ = {answer.force.x, answer.force.y, answer.force.z};
    if (felt_.norm() > before.norm()) largest_step_n_ = std::max(largest_step_n_, (felt_ - before).norm());
  }

  runtime::FaultList faults_;
  Bench bench_{make_model(flap(), {holding_jaws()})};
  haptic::ToolLine line_{0, {}, faults_};
  Vec3 tip_ = Vec3::Zero(), felt_ = Vec3::Zero();
  double grip_ = 0;
  std::int64_t now_ns_ = 0;
  std::uint64_t heard_ = 0;
};

TEST_F(MomentaryHold, ASilenceEndsTheForceAndNotTheHold) {
  largest_step_n_ = 0;
  be_silent(60);
  EXPECT_EQ(felt_n(), 0);
  EXPECT_TRUE(jaws().grasping);
  rest_for(400);
  EXPECT_TRUE(jaws().grasping);
  EXPECT_NEAR(felt_n(), held_n_, 0.02 * held_n_);
  EXPECT_LE(largest_step_n_, kHoldSlew_n);
  EXPECT_EQ(jaws().grasps.lost, 0u);
}

// What moved it felt nothing, and did no work.
TEST_F(MomentaryHold, JawsThatAreElsewhereAfterwardsHaveSlipped) {
  const double stored_j = bench_account_j();
  be_silent(60);
  jump(Vec3(0, 0.001, 0.004));
  rest_for(400);
  EXPECT_TRUE(jaws().grasping);
  EXPECT_NEAR(felt_n(), held_n_, 0.02 * held_n_);
  EXPECT_LE(bench_account_j(), 1.02 * stored_j);
  go_to(pulled_ + Vec3(0, 0.001, 0.009), kShut_rad, 300);
  EXPECT_GT(felt_n(), held_n_) << "they hold and pull";
}

TEST_F(MomentaryHold, ALongSilenceEndsIt) {
  be_silent(250);
  EXPECT_FALSE(jaws().grasping);
  EXPECT_EQ(jaws().grasps.lost, 1u);
}

TEST_F(MomentaryHold, WhoComesBackFarAwayHoldsNothing) {
  be_silent(60);
  jump(Vec3(0, 0, 0.03));
  rest_for(100);
  EXPECT_FALSE(jaws().grasping);
  EXPECT_EQ(felt_n(), 0);
  EXPECT_EQ(jaws().grasps.lost, 1u);
}

TEST_F(MomentaryHold, JawsThatOpenedMeanwhileHoldNothing) {
  be_silent(60);
  go_to(pulled_, kOpen_rad, 1);
  EXPECT_FALSE(jaws().grasping);
  EXPECT_EQ(jaws().grasps.lost, 0u) << "their hand let go";
}

}  // namespace
}  // namespace omentum::haptic_test
