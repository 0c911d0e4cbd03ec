// What is told of a tool's contacts, organ by organ.
#include "haptic_fixtures.h"
#include "haptic_node/contact_message.h"

namespace omentum::haptic_test {
namespace {

constexpr double kOpen_rad = 0.5, kShut_rad = 0.05;

// Two blocks side by side; two graspers press one each, and the first one has closed its jaws.
class HeldBlock : public testing::Test {
 protected:
  HeldBlock() {
    for (int i = 0; i <= 80; ++i) press(i, kOpen_rad);
    press(80, kShut_rad);
  }

  msg::Contact told(std::int32_t tool, std::uint32_t organ) {
    msg::Contact message = haptic::make_contact_message(static_cast<std::uint32_t>(tool), organ);
    haptic::fill_contact_message(tool, bench_.output(static_cast<std::size_t>(tool)), bench_.state(),
                                 bench_.work().bodies, message);
    return message;
  }

  void press(int tick, double grip_rad) {
    const Vec3 tip = Vec3(0.05, 0.05, 0.041) - Vec3(0, 0, 1e-4 * tick);
    bench_.place(0, tip, grip_rad).place(1, tip + kBeside, kOpen_rad).step();
  }

  static inline const Vec3 kBeside{0.12, 0, 0};
  Bench bench_{[] {
    haptic::ToolModel grasper = round_tool();
    grasper.grasps = true;
    haptic::HapticModel model = make_model(block(), {grasper, grasper});
    model.organs.push_back(elastic_surface(block()));
    for (Vec3& x : model.organs.back().rest) x += kBeside;
    return model;
  }()};
};

TEST_F(HeldBlock, EachOrganHearsOfItsOwnForces) {
  for (const std::int32_t tool : {0, 1}) {
    EXPECT_FALSE(told(tool, static_cast<std::uint32_t>(tool)).nodes.empty());
    EXPECT_TRUE(told(tool, static_cast<std::uint32_t>(1 - tool)).nodes.empty());
  }
}

TEST_F(HeldBlock, OnlyTheOrganBetweenTheJawsIsGrasped) {
  ASSERT_TRUE(bench_.output(0).grasping);
  EXPECT_TRUE(told(0, 0).grasping);
  EXPECT_FALSE(told(0, 1).grasping);
  EXPECT_EQ(told(0, 1).grasp_count, 1u) << "a count of the tool's grasps";
  EXPECT_FALSE(told(1, 0).grasping) << "another tool's jaws are open";
  EXPECT_FALSE(told(1, 1).grasping);
  EXPECT_TRUE(haptic::touches(0, 0, bench_.state(), bench_.work().bodies));
  EXPECT_FALSE(haptic::touches(0, 1, bench_.state(), bench_.work().bodies));
}

TEST_F(HeldBlock, OpenJawsHoldNothing) {
  press(80, kOpen_rad);
  for (const std::uint32_t organ : {0u, 1u}) EXPECT_FALSE(told(0, organ).grasping);
}

}  // namespace
}  // namespace omentum::haptic_test
