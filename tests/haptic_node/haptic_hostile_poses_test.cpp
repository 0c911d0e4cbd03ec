// A hundred thousand poses of anything on the topic of a hand that presses: haptic_node's loop on a scripted
// bus.
#include "tests/haptic_node/force_watch.h"
#include "tests/haptic_node/haptic_stage.h"
#include "tests/haptic_node/hostile_poses.h"

#include <gmock/gmock.h>

namespace omentum::haptic_test {
namespace {

class HostilePosesTest : public HapticLoopTest {
 protected:
  void look() {
    for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>())
      if (force.tool == 0) watch_.see(force);
  }
  ForceWatch watch_;
};

TEST_F(HostilePosesTest, NeitherTakeAHandsForceNorLiftAnyLimitOfIt) {
  constexpr int kTicks = 10'000, kRubbish = 9;  // in each: 10 kHz
  constexpr double kWeakDevice_n = 0.4;
  const auto node = serving();
  look();
  HostilePoses poses(seq_);
  double strong_n = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    if (tick == kTicks / 2) {
      strong_n = watch_.largest_n();
      msg::DeviceInfo weak{};
      weak.max_force_n = kWeakDevice_n;
      weak.max_torque_nm = 1;
      weak.max_stiffness_n_m = 1000;
      bus_.post(weak);
      watch_.limits.max_force_n = kWeakDevice_n;
    }
    bus_.post(poses.honest(node->pace().now_ns()));
    for (int i = 0; i < kRubbish; ++i) bus_.post(poses.rubbish());
    ASSERT_TRUE(node->tick());
    look();
    ASSERT_EQ(watch_.broken(), "") << "tick " << tick;
  }
  EXPECT_GT(strong_n, 2 * kWeakDevice_n) << "a force of zero is safe and useless";
  for (const char* refused : {"not finite", "jumps", "older", "no unit quaternion"})
    EXPECT_THAT(faults(), testing::Contains(testing::HasSubstr(refused)));

  // and when nothing is heard any more
  constexpr int kSilence = 25;  // ms: stale after 5, decayed after 20 more
  for (int tick = 0; tick <= kSilence; ++tick) ASSERT_TRUE(node->tick());
  look();
  EXPECT_EQ(watch_.newest_n(), 0);
  EXPECT_EQ(watch_.broken(), "");
  EXPECT_EQ(node->end(), "");
}

}  // namespace
}  // namespace omentum::haptic_test
