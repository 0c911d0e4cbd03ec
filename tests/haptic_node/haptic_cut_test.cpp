// haptic_node's loop with a tool that cuts: what it tells of its edge.
#include "tests/haptic_node/haptic_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using haptic_test::vector;

class HapticCutTest : public HapticLoopTest {
 protected:
  void SetUp() override {
    scene_ = block().scene_with("[[tools]]\nid = 0\n",
                                "[[tools]]\nid = 0\ncuts = true\nedge = [[0,0,0.001], [0,0,0.013]]\n");
  }
  std::unique_ptr<haptic_test::Node> hooked() {
    options_.node.scene = scene_;
    options_.rate_hz = haptic_test::kRate_hz;
    auto node = std::make_unique<haptic_test::Node>(haptic_test::kRate_hz, options_, bus_.opener());
    move_by(*node, 0, 1300, false);
    bus_.take_all<msg::Contact>();
    return node;
  }
  /// Along x, so far in each of so many ticks.
  void move_by(haptic_test::Node& node, double step_m, int ticks, bool pressed) {
    for (int i = 0; i < ticks; ++i) {
      tip_.x() += step_m;
      msg::ToolPose pose = pose_at(node, tip_);
      pose.buttons = pressed ? msg::BUTTON_CUT : 0;
      bus_.post(pose);
      node.tick();
    }
  }
  std::vector<msg::Contact> contacts() {
    std::vector<msg::Contact> of_probe;
    for (const msg::Contact& contact : bus_.take_all<msg::Contact>())
      if (contact.tool == 0) of_probe.push_back(contact);
    return of_probe;
  }

  std::string scene_;
  Vec3 tip_ = kAbove;
};

TEST_F(HapticCutTest, AButtonsStrokeIsToldWithoutAGapAlsoInTheAir) {
  const auto node = hooked();
  const double from_m = tip_.x();
  move_by(*node, 1e-4, 50, true);
  const double to_m = tip_.x();
  move_by(*node, 0, 10, false);
  const auto told = contacts();
  std::vector<msg::Contact> cutting;
  std::ranges::copy_if(told, std::back_inserter(cutting), &msg::Contact::cutting);
  ASSERT_GE(cutting.size(), 12u);
  EXPECT_NEAR(cutting.front().edge_before.begin.x, from_m + 1e-4, 1e-12) << "where the button came down";
  EXPECT_NEAR(told.back().edge.begin.x, to_m, 1e-12) << "where it went up";
  EXPECT_NEAR(told.back().edge_before.begin.x, to_m, 1e-12);
  for (std::size_t i = 1; i < cutting.size(); ++i) {
    EXPECT_EQ(vector(cutting[i].edge_before.begin), vector(cutting[i - 1].edge.begin));
    EXPECT_NEAR((vector(cutting[i].edge.end) - vector(cutting[i].edge.begin)).norm(), 0.012, 1e-12);
    EXPECT_EQ(cutting[i].cut_count, 1u);
  }
  EXPECT_FALSE(told.back().cutting);
  EXPECT_EQ(told.back().cut_count, 1u);
}

TEST_F(HapticCutTest, EachCutIsCounted) {
  const auto node = hooked();
  for (int i = 0; i < 3; ++i) {
    move_by(*node, 1e-4, 20, true);
    move_by(*node, 1e-4, 20, false);
  }
  EXPECT_EQ(contacts().back().cut_count, 3u);
}

TEST_F(HapticCutTest, APausedSessionCutsNothing) {
  const auto node = hooked();
  command(msg::COMMAND_PAUSE);
  move_by(*node, 1e-4, 20, true);
  for (const msg::Contact& contact : contacts()) EXPECT_FALSE(contact.cutting);
}

TEST_F(HapticCutTest, WhoFallsSilentEndsTheCutWhereItWasLast) {
  const auto node = hooked();
  move_by(*node, 1e-4, 20, true);
  const double last_m = tip_.x();
  node->tick(100);
  const auto told = contacts();
  EXPECT_FALSE(told.back().cutting);
  EXPECT_NEAR(told.back().edge.begin.x, last_m, 1e-12);
}

TEST_F(HapticCutTest, AToolWithoutAnEdgeCutsNothing) {
  const auto node = serving();
  move_by(*node, 1e-4, 20, true);
  for (const msg::Contact& contact : contacts()) EXPECT_FALSE(contact.cutting);
}

}  // namespace
}  // namespace omentum::haptic
