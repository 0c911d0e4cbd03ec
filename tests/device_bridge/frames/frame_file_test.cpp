#include "device_bridge/frames/frame_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>

namespace omentum::device {
namespace {

struct FrameFileTest : ::testing::Test {
  std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) /
      (::testing::UnitTest::GetInstance()->current_test_info()->name() + std::string("_frames.toml"));
  std::vector<scene::ToolSpec> tools{2};

  FrameFileTest() {  // tool 1 goes through a port
    tools[1].id = 1;
    tools[1].shaft_length_m = 0.36;
    tools[1].trocar = Vec3(0, 0, 0.1);
  }
  ~FrameFileTest() override { std::filesystem::remove(file); }
  auto read(const std::string& text) {
    std::ofstream(file) << text;
    return read_frames(file, tools);
  }
  void expect_refusal(const std::string& device, const std::string& why) {
    try {
      read("[[devices]]\n" + device);
      ADD_FAILURE() << "took " << device;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(why));
    }
  }
};

TEST_F(FrameFileTest, WhatIsLeftOutIsAsTheSceneHasIt) {
  const auto mappings = read("[[devices]]\ntool = 0\n");
  ASSERT_EQ(mappings.size(), 1U);
  const MappingSpec& spec = mappings.at(0);
  EXPECT_TRUE(spec.base.q_WB.isApprox(Quat::Identity()));
  EXPECT_EQ(spec.base.scale, 1);
  EXPECT_EQ(spec.force_scale, 1);
  EXPECT_FALSE(spec.lever || spec.clutch_button || spec.enable_button);
}

TEST_F(FrameFileTest, EveryKeyIsRead) {
  const MappingSpec spec = read(
                               "[[devices]]\ntool = 1\norigin = [0.1, 0.2, 0.3]\nx_axis = [0, 1, 0]\n"
                               "z_axis = [0, 0, 1]\nscale = 0.5\nforce_scale = 2.0\nholds = \"handle\"\n"
                               "least_outside_m = 0.08\nclutch_button = 1\nenable_button = 2\n")
                               .at(1);
  EXPECT_LT((spec.base.q_WB * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((spec.base.q_WB * Vec3::UnitY() + Vec3::UnitX()).norm(), 1e-12);
  EXPECT_EQ(spec.base.p_WB, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(spec.base.scale, 0.5);
  EXPECT_EQ(spec.force_scale, 2);
  EXPECT_EQ(spec.clutch_button, 1U);
  EXPECT_EQ(spec.enable_button, 2U);
  ASSERT_TRUE(spec.lever);
  EXPECT_EQ(spec.lever->pivot, Vec3(0, 0, 0.1));
  EXPECT_EQ(spec.lever->length_m, 0.36);
  EXPECT_EQ(spec.lever->least_outside_m, 0.08);
}

TEST_F(FrameFileTest, WhatCannotBeIsRefusedWithItsLine) {
  expect_refusal("tool = 5\n", "frames.toml:2: devices[0].tool: found 5");
  expect_refusal("tool = 0\nholds = \"handle\"\n",
                 "frames.toml:3: devices[0].holds: found \"handle\" of a tool");
  expect_refusal("tool = 0\nx_axis = [0, 0, 1]\n", "axes across each other");
  expect_refusal("tool = 0\nscale = 0\n", "scale");
  expect_refusal("tool = 0\nclutch_button = 0\n", "0, which cuts");
  expect_refusal("tool = 0\nclutch_button = 3\nenable_button = 3\n", "another one");
  expect_refusal("tool = 0\nclutch = 3\n", "\"clutch_button\", \"enable_button\"");
  expect_refusal("tool = 0\norigin = [0, -300, 200]\n", "frames.toml:3: devices[0].origin: found 360");
  expect_refusal("tool = 0\n[[devices]]\ntool = 0\n", "0 again");
}

TEST_F(FrameFileTest, TheExampleFitsTheLiver) {
  const std::filesystem::path root = OMENTUM_SOURCE_DIR;
  const scene::Scene liver = scene::load_scene(root / "scenes/liver.toml");
  const auto mappings = read_frames(root / "device_bridge/examples/frames.toml", liver.tools);
  ASSERT_TRUE(mappings.at(0).lever);
  EXPECT_EQ(mappings.at(0).lever->pivot, *liver.tools[0].trocar);
  EXPECT_EQ(mappings.at(0).lever->least_outside_m, 0.1);
  EXPECT_EQ(mappings.at(0).clutch_button, 1U);
}

}  // namespace
}  // namespace omentum::device
