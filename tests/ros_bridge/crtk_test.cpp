#include "ros_bridge/crtk.h"

#include <gtest/gtest.h>

namespace omentum::ros {
namespace {

struct CrtkTest : ::testing::Test {
  CrtkTest() {
    pose.valid = true;
    pose.position = {0.1, 0.2, 0.3};
    pose.orientation = {0.5, -0.5, 0.5, -0.5};  // w first
    pose.linear_velocity = {1, 2, 3};
    pose.angular_velocity = {4, 5, 6};
    force.force = {7, 8, 9};
    force.torque = {0.1, 0.2, 0.3};
    tool = {&pose, &force, 1'700'000'000'123'456'789, 1'700'000'001'000'000'001};
  }
  msg::ToolPose pose;
  msg::ToolForce force;
  ToolNow tool;
  std::string frame = "world";
};

TEST_F(CrtkTest, APoseKeepsItsPlaceAndPutsWLast) {
  const PoseStamped stamped = measured_cp(tool, frame);
  EXPECT_EQ(stamped.header_.stamp_.sec_, 1'700'000'000);
  EXPECT_EQ(stamped.header_.stamp_.nanosec_, 123'456'789U);
  EXPECT_STREQ(stamped.header_.frame_id_, "world");
  EXPECT_EQ(stamped.pose_.position_.z_, 0.3);
  EXPECT_EQ(stamped.pose_.orientation_.w_, 0.5);
  EXPECT_EQ(stamped.pose_.orientation_.x_, -0.5);
  EXPECT_EQ(stamped.pose_.orientation_.z_, -0.5);
}

TEST_F(CrtkTest, WhatIsNotValidHasTheStampZeroAndStaysARotation) {
  pose.valid = false;
  for (const msg::ToolPose* none :
       {static_cast<const msg::ToolPose*>(&pose), static_cast<const msg::ToolPose*>(nullptr)}) {
    tool.pose = none;
    const PoseStamped stamped = measured_cp(tool, frame);
    EXPECT_EQ(stamped.header_.stamp_.sec_, 0);
    EXPECT_EQ(stamped.header_.stamp_.nanosec_, 0U);
    EXPECT_EQ(stamped.pose_.orientation_.w_, 1);
    const CartesianState state = measured_cs(tool, frame);
    EXPECT_EQ(state.header_.stamp_.sec_, 0);
    EXPECT_FALSE(state.pose_is_valid_.data_ || state.twist_is_valid_.data_);
  }
  tool.force = nullptr;
  EXPECT_EQ(servo_cf(tool, frame).header_.stamp_.sec_, 0);
}

TEST_F(CrtkTest, AStateHasPoseAndTwistAndNoMeasuredWrench) {
  const CartesianState state = measured_cs(tool, frame);
  EXPECT_TRUE(state.pose_is_valid_.data_ && state.twist_is_valid_.data_);
  EXPECT_FALSE(state.wrench_is_valid_.data_);
  EXPECT_EQ(state.twist_.linear_.y_, 2);
  EXPECT_EQ(state.twist_.angular_.z_, 6);
}

TEST_F(CrtkTest, AForceIsTheAnswersWithItsOwnStamp) {
  const WrenchStamped stamped = servo_cf(tool, frame);
  EXPECT_EQ(stamped.header_.stamp_.sec_, 1'700'000'001);
  EXPECT_EQ(stamped.header_.stamp_.nanosec_, 1U);
  EXPECT_EQ(stamped.wrench_.force_.z_, 9);
  EXPECT_EQ(stamped.wrench_.torque_.y_, 0.2);
}

TEST_F(CrtkTest, OneOfFourStatesHolds) {
  EXPECT_EQ(operating(tool), Operating::kEnabled);
  force.state = msg::FORCE_CLAMPED | msg::FORCE_PAUSED;
  EXPECT_EQ(operating(tool), Operating::kPaused);
  force.state |= msg::FORCE_FAULT;
  EXPECT_EQ(operating(tool), Operating::kFault);
  tool.pose = nullptr;  // a fault is latched whoever measures
  EXPECT_EQ(operating(tool), Operating::kFault);
  force.state = 0;
  EXPECT_EQ(operating(tool), Operating::kDisabled);
  tool.pose = &pose;
  tool.force = nullptr;
  EXPECT_EQ(operating(tool), Operating::kDisabled);
}

TEST_F(CrtkTest, AStateIsToldInCrtksWords) {
  const OperatingState state = operating_state(Operating::kFault, true, 5'000'000'007, frame);
  EXPECT_STREQ(state.state_, "FAULT");
  EXPECT_EQ(state.header_.stamp_.sec_, 5);
  EXPECT_EQ(state.header_.stamp_.nanosec_, 7U);
  EXPECT_TRUE(state.is_homed_);
  EXPECT_FALSE(state.is_busy_);
}

TEST_F(CrtkTest, CommandsAreTakenWhereCrtkHasATransition) {
  EXPECT_EQ(command_of("pause", Operating::kEnabled), msg::COMMAND_PAUSE);
  EXPECT_EQ(command_of("resume", Operating::kPaused), msg::COMMAND_START);
  EXPECT_EQ(command_of("enable", Operating::kFault), msg::COMMAND_CLEAR_FAULT);
  for (const Operating state : {Operating::kDisabled, Operating::kEnabled, Operating::kPaused})
    EXPECT_FALSE(command_of("enable", state));
  EXPECT_FALSE(command_of("pause", Operating::kFault));
  EXPECT_FALSE(command_of("resume", Operating::kEnabled));
  EXPECT_FALSE(command_of("disable", Operating::kEnabled));
  EXPECT_FALSE(command_of("", Operating::kEnabled));
}

TEST_F(CrtkTest, ANamespaceIsWhatRosTakes) {
  for (const char* good : {"PSM1", "tool0", "_a", "right_hand"}) EXPECT_TRUE(is_namespace(good)) << good;
  for (const char* bad : {"", "1PSM", "right hand", "a/b", "\xc3\xa9"})
    EXPECT_FALSE(is_namespace(bad)) << bad;
}

}  // namespace
}  // namespace omentum::ros
