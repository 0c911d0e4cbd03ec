// A device whose quality of service is too little is told so, by name where one is known.
#include "haptic_node/unheard_writers.h"

#include "tests/haptic_node/haptic_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using transport::QosPolicy;

constexpr transport::WriterId kArm{0x66};
constexpr int kToldTicks = 1200;  // the wait for a name, and a status

class UnheardWritersTest : public HapticLoopTest {
 protected:
  void introduce(std::uint32_t tool, const std::string& name) {
    msg::DeviceInfo info{};
    info.tool = tool;
    info.name = name;
    info.max_force_n = 3;
    info.max_torque_nm = 1;
    info.max_stiffness_n_m = 1000;
    bus_.post(info, kArm);
  }
};

TEST_F(UnheardWritersTest, ADeviceWithoutALeaseIsNamedWithWhatToOffer) {
  const auto node = serving();
  bus_.offer_too_little<msg::ToolPose>(QosPolicy::kLiveliness);
  hold(*node, kAbove, 100);
  EXPECT_THAT(faults(), IsEmpty()) << "it may say its name yet";
  introduce(3, "omega.7 left");
  introduce(0, "omega.7 right");  // which is heard
  hold(*node, kAbove, kToldTicks);
  EXPECT_THAT(faults(),
              ElementsAre(HasSubstr("tool 3: poses not heard, LIVELINESS must be automatic, a lease of "
                                    "at most 100 ms: 'omega.7 left'")));
  EXPECT_EQ(node->end(), "");
}

TEST_F(UnheardWritersTest, OneThatNobodyKnowsIsToldByItsTopicOncePerPolicy) {
  const auto node = serving();
  for (int i = 0; i < 3; ++i) {
    bus_.offer_too_little<msg::ToolPose>(QosPolicy::kLiveliness);
    bus_.offer_too_little<msg::DeviceInfo>(QosPolicy::kDurability);
    bus_.offer_too_little<msg::DeviceInfo>(QosPolicy::kReliability);
  }
  hold(*node, kAbove, 2 * kToldTicks);
  EXPECT_THAT(
      faults(),
      ElementsAre(HasSubstr("tool_pose: a writer is not heard, LIVELINESS must be automatic, a lease of "
                            "at most 100 ms"),
                  HasSubstr("device_info: a writer is not heard, DURABILITY must be transient local"),
                  HasSubstr("device_info: a writer is not heard, RELIABILITY must be reliable")));
  EXPECT_EQ(node->end(), "");
}

}  // namespace
}  // namespace omentum::haptic
