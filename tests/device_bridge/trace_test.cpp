#include "device_bridge/trace.h"

#include "device_bridge/trace_player.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace omentum::device {
namespace {

using ::testing::HasSubstr;

const std::string kHeader = "t_s,px,py,pz,qw,qx,qy,qz,grip\n";

struct TraceFile : ::testing::Test {
  test::ScratchFolder folder;
  std::filesystem::path file = folder / "trace.csv";
  void write(const std::string& text) const { std::ofstream(file) << text; }
  std::string message() const {
    try {
      read_trace(file);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(TraceFile, ColumnsMayComeInAnyOrderWithSpacesAndComments) {
  write(
      "# a hand\ntool, grip,t_s,px,py,pz,qx,qy,qz,qw\r\n\n1, 0.5, 10, 1,2,3, "
      "0,0,0,1\n1,0.5,11,1,2,4,0,0,0,1\n0,0,3,0,0,0,0,0,0,1\n");
  const auto traces = read_trace(file);
  ASSERT_EQ(traces.size(), 2u);
  ASSERT_EQ(traces.at(1).size(), 2u);
  EXPECT_EQ(traces.at(1)[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(traces.at(1)[0].grip, 0.5);
  EXPECT_EQ(traces.at(1)[0].orientation.w(), 1);
  EXPECT_EQ(traces.at(0)[0].t_s, 3);
}

TEST_F(TraceFile, AByteOrderMarkIsPassedOver) {
  for (const char* before : {"", "# saved by a spreadsheet\n"}) {
    write("\xEF\xBB\xBF" + std::string(before) + kHeader + "0,1,2,3,1,0,0,0,0\n");
    EXPECT_EQ(message(), "accepted");
    EXPECT_EQ(read_trace(file).at(0)[0].position, Vec3(1, 2, 3));
  }
}

TEST_F(TraceFile, AFileOfAnotherKindIsNamed) {
  using namespace std::string_literals;
  write("\x1f\x8b\x08\0\0"s);
  EXPECT_THAT(message(), HasSubstr("found gzip-compressed data"));
  write("\xff\xfet\0_\0s\0"s);
  EXPECT_THAT(message(), HasSubstr("found UTF-16 text"));
}

TEST_F(TraceFile, AnotherSeparatorIsNamed) {
  write("t_s;px;py;pz;qw;qx;qy;qz;grip\n0;1;2;3;1;0;0;0;0\n");
  EXPECT_THAT(message(), HasSubstr("trace.csv:1: found fields separated by ';', expected ','"));
  write(kHeader + std::string("0\t1\t2\t3\t1\t0\t0\t0\t0\n"));
  EXPECT_THAT(message(), HasSubstr("trace.csv:2: found fields separated by tabs, expected ','"));
}

TEST_F(TraceFile, WhatWasRecordedIsReadBack) {
  {
    TraceLog log(file);
    for (int i = 0; i < 300; ++i) {
      msg::ToolPose pose;
      pose.tool = i % 2;
      pose.stamp_ns = 7'000'000'000 + i * 500'000;
      pose.valid = i != 6;
      pose.position = {0.001 * i, -1.0 / 3, 2e-5};
      pose.orientation = {0.6, 0, 0.8, 0};
      pose.grip = 0.25;
      pose.buttons = i < 100 ? 0x80000001U : 2;
      log.push(pose);
      log.push(
          pose);  // the device had no newer measurement: read_trace would refuse a time that does not grow
    }
  }
  const auto traces = read_trace(file);
  ASSERT_EQ(traces.size(), 2u);
  EXPECT_EQ(traces.at(0).size(), 150u);  // for the invalid one the buttons are let go
  EXPECT_EQ(traces.at(0)[2].buttons, 0x80000001U);
  EXPECT_NEAR(traces.at(0)[3].t_s, 4 * 0.0005 + 1e-6, 1e-9);
  EXPECT_EQ(traces.at(0)[3].position, traces.at(0)[2].position);
  EXPECT_EQ(traces.at(0)[3].buttons, 0U);
  EXPECT_EQ(traces.at(1).size(), 150u);
  const TracePoint& point = traces.at(1)[2];  // i = 5
  EXPECT_NEAR(point.t_s, 5 * 0.0005, 1e-9);
  EXPECT_LT((point.position - Vec3(0.005, -1.0 / 3, 2e-5)).norm(), 1e-9);
  EXPECT_NEAR(point.orientation.y(), 0.8, 1e-9);
  EXPECT_NEAR(point.grip, 0.25, 1e-6);
  EXPECT_EQ(point.buttons, 0x80000001U);
  EXPECT_EQ(traces.at(0).back().buttons, 2U);
}

TEST_F(TraceFile, OneOfBeforeThereWereButtonsPressesNone) {
  write(kHeader + "0,0,0,0,1,0,0,0,0\n1,0,0,0,1,0,0,0,0\n");
  EXPECT_EQ(trace_at(read_trace(file).at(0), 0.5).buttons, 0U);
}

TEST_F(TraceFile, BadOnesAreRefusedNamingFileLineAndWhatWasExpected) {
  struct Bad {
    std::string text;
    int line;
    const char* says;
  };
  const std::string good = "0,0,0,0,1,0,0,0,0\n";
  const std::vector<Bad> table{
      {"", 0, "found nothing, expected a header"},
      {kHeader, 1, "found no pose"},
      {"t_s,px,py,pz,qw,qx,qy,qz\n", 1, "no column grip"},
      {"t_s,px,py,pz,qw,qx,qy,qz,grip,force\n", 1, "column 'force'"},
      {"t_s,px,px,pz,qw,qx,qy,qz,grip\n", 1, "column 'px'"},
      {kHeader + good + "1,0,0,0,1,0,0,0\n", 3, "8 fields, expected 9"},
      {kHeader + good + "1,0,zero,0,1,0,0,0,0\n", 3, "'zero' in column py"},
      {kHeader + good + "1,0,nan,0,1,0,0,0,0\n", 3, "'nan' in column py"},
      {kHeader + good + "1,0,,0,1,0,0,0,0\n", 3, "'' in column py"},
      {kHeader + good + "0,0,0,0,1,0,0,0,0\n", 3, "times that grow"},
      {kHeader + "0,0,0,0,0.9,0,0,0,0\n", 2, "a unit quaternion"},
      {"t_s,px,py,pz,qw,qx,qy,qz,grip,tool\n0,0,0,0,1,0,0,0,0,8\n", 2, "a whole number from 0 to 7"},
      {"t_s,px,py,pz,qw,qx,qy,qz,grip,tool\n0,0,0,0,1,0,0,0,0,0.5\n", 2, "a whole number from 0 to 7"},
      {"t_s,px,py,pz,qw,qx,qy,qz,grip,buttons\n0,0,0,0,1,0,0,0,0,-1\n", 2, "buttons -1.000000"},
      {"t_s,px,py,pz,qw,qx,qy,qz,grip,buttons\n0,0,0,0,1,0,0,0,0,4294967296\n", 2, "0 to 4294967295"},
  };
  for (const Bad& bad : table) {
    write(bad.text);
    EXPECT_THAT(message(), HasSubstr(file.string() + ":" + std::to_string(bad.line) + ": found "))
        << bad.text;
    EXPECT_THAT(message(), HasSubstr(bad.says)) << bad.text;
  }
  std::filesystem::remove(file);
  EXPECT_THAT(message(), HasSubstr(file.string() + ": found no readable file"));
}

Trace two_points() {
  return {{.t_s = 2, .position = {0, 0, 0}, .grip = 0},
          {.t_s = 4,
           .position = {1, 0, 0},
           .orientation = Quat(Eigen::AngleAxisd(0.8, Vec3::UnitZ())),
           .grip = 1}};
}

TEST(TraceAt, MovesEvenlyBetweenPoints) {
  const Measurement m = trace_at(two_points(), 2.5);
  EXPECT_TRUE(m.valid);
  EXPECT_TRUE(m.position.isApprox(Vec3(0.25, 0, 0)));
  EXPECT_TRUE(m.linear_velocity.isApprox(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(m.angular_velocity.isApprox(Vec3(0, 0, 0.4)));
  EXPECT_NEAR(m.orientation.angularDistance(Quat(Eigen::AngleAxisd(0.2, Vec3::UnitZ()))), 0, 1e-12);
  EXPECT_DOUBLE_EQ(m.grip, 0.25);
}

TEST(TraceAt, RestsBeforeTheFirstAndAfterTheLastPoint) {
  EXPECT_EQ(trace_at(two_points(), 0).position.x(), 0);
  EXPECT_EQ(trace_at(two_points(), 0).linear_velocity.norm(), 0);
  EXPECT_EQ(trace_at(two_points(), 4).position.x(), 1);
  EXPECT_EQ(trace_at(two_points(), 99).linear_velocity.norm(), 0);
}

TEST(TraceAt, ButtonsArePressedFromPointToPointAndByNobodyAfterTheLast) {
  Trace trace = two_points();
  trace[0].buttons = 1;
  trace[1].buttons = 5;
  EXPECT_EQ(trace_at(trace, 2).buttons, 1U);
  EXPECT_EQ(trace_at(trace, 3.999).buttons, 1U);
  EXPECT_EQ(trace_at(trace, 4).buttons, 0U);
}

// A cut and a clutch are in what is played as they were in what was recorded.
TEST(TracePlayer, PressesTheButtonsThatWerePressed) {
  TracePlayer player(0, {{.t_s = 0}, {.t_s = 1, .buttons = 1}, {.t_s = 2}, {.t_s = 3}}, 1);
  std::vector<std::uint32_t> pressed;
  for (int i = 0; i < 4; ++i) pressed.push_back(player.measure(0).buttons);
  EXPECT_EQ(pressed, (std::vector<std::uint32_t>{0, 1, 0, 0}));
}

TEST(TracePlayer, PlaysPausesAndRestarts) {
  TracePlayer player(1, two_points(), 4);
  EXPECT_EQ(player.info().tool, 1u);
  EXPECT_EQ(player.measure(0).position.x(), 0);
  EXPECT_DOUBLE_EQ(player.measure(0).position.x(), 0.125);
  player.pause(true);
  player.measure(0);
  const Measurement held = player.measure(0);
  EXPECT_DOUBLE_EQ(held.position.x(), 0.25);
  EXPECT_EQ(held.linear_velocity.norm(), 0);
  player.pause(false);
  player.restart();
  EXPECT_EQ(player.measure(0).position.x(), 0);
}

}  // namespace
}  // namespace omentum::device
