// One hand pulls at an organ that moves by itself, the other one cuts: haptic step and organ together.
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

constexpr double kTop_m = test::BlockScene::kSide, kOpen_rad = 0.5;
// A tick of the scene's slew limit, N.
constexpr double kSlew_n = 2000.0 / 1000;
const Vec3 kMiddle(0.05, 0.05, kTop_m);

// A grasper, and a wire that is as long as the block is wide.
const test::BlockScene& block() {
  static const test::BlockScene scene(
      4,
      "[[tools]]\nid = 0\nname = \"grasper\"\nshape = \"grasper\"\ngrip_force_n = 40\n"
      "points = [[0.003,0.002,0], [0.003,-0.002,0], [-0.003,0.002,0], [-0.003,-0.002,0]]\n"
      "[[tools]]\nid = 1\nname = \"wire\"\nshape = \"probe\"\npoints = [[0,0,0]]\n"
      "cuts = true\nedge = [[0,0.01,0], [0,0.15,0]]\n"
      "[score]\nplanned_line = [[0, 0, 0.06], [0.1, 0, 0.06]]\n");
  return scene;
}

class GraspExchange : public testing::Test {
 protected:
  GraspExchange()
      : session_(1000, 100,
                 {.file = block().scene_with("young_pa",
                                             "model = \"tensor-mass\"\ngravity_m_s2 = [0, 0, 0]\n"
                                             "mass_damping_per_s = 10\ncut_delay_s = 0.02\nyoung_pa"),
                  .felt = scene::kOrganModels,
                  .moved = deform::model_table()}) {}

  /// Closes its jaws in the middle of the top, and pulls by `up_m`.
  Vec3 grasp_and_pull(double up_m) {
    session_.open_jaws(kOpen_rad);
    session_.move_to(kMiddle + Vec3(0, 0, 0.01), test::kListens_s + 0.5);
    session_.move_to(kMiddle - Vec3(0, 0, 0.003), 0.3);
    for (int i = 0; i <= 300; ++i) {
      session_.open_jaws(kOpen_rad * (1 - i / 300.0));
      session_.move_to(kMiddle - Vec3(0, 0, 0.003), 1e-3);
    }
    const Vec3 pulled = kMiddle + Vec3(0, 0, up_m);
    session_.move_to(pulled, 0.5);
    return session_.move_to(pulled, 0.5);
  }
  /// The wire goes through the block at that height, at 10 cm a second, while the grasper is held.
  std::vector<double> pull_while_cut_at(double height_m, const Vec3& held) {
    std::vector<double> pull_n;
    for (int i = 0; i < 1600; ++i) {
      session_.place_other(1, Vec3(-0.03 + 1e-4 * i, -0.03, height_m), true);
      pull_n.push_back(session_.move_to(held, 1e-3).norm());
    }
    for (int i = 0; i < 500; ++i) pull_n.push_back(session_.move_to(held, 1e-3).norm());
    return pull_n;
  }

  Session session_;
};

TEST_F(GraspExchange, TheHandFeelsTheTissueGiveWhenTheLastBridgeGoes) {
  const Vec3 pulled = kMiddle + Vec3(0, 0, 0.015);
  const double whole_n = -grasp_and_pull(0.015).z();
  ASSERT_GT(whole_n, 0.5);
  const double put_in_j = -session_.given_j();
  const std::vector<double> pull_n = pull_while_cut_at(0.06, pulled);
  EXPECT_GT(pull_n[900], 0.2 * whole_n) << "a bridge of four centimetres is left";
  EXPECT_LT(pull_n.back(), 0.03 * whole_n) << "the piece hangs on nothing but the jaws";
  EXPECT_LE(session_.largest_step_n(), kSlew_n);
  session_.move_to(pulled + Vec3(0.02, 0, 0.02), 0.5);
  EXPECT_LT(session_.given_j(), 0.02 * put_in_j) << "of " << put_in_j;
  const auto hand = session_.hand_report(), organ = session_.organ_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
  EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  EXPECT_EQ(hand["hands"][0]["grasps"]["lost"], 0) << "it is still held";
  EXPECT_GT(organ["removed_tetrahedra"], 30);
  EXPECT_EQ(hand["hands"][0]["pulls_beyond_limit"], 1);
  EXPECT_GE(hand["hands"][0]["pull_max_n"], whole_n);
  const auto score = organ["score"];
  EXPECT_NEAR(score["way_mm"].get<double>(), 100, 10);
  EXPECT_NEAR(score["seconds"].get<double>(), 1, 0.1) << "10 cm at 10 cm a second";
  EXPECT_LT(score["mean_mm"], 10) << "the pull lifts the line by some millimetres";
  EXPECT_LT(score["outside_cm3"], 0.2 * score["removed_cm3"].get<double>());
}

TEST_F(GraspExchange, WhatIsCutAwayBetweenTheJawsIsHeldNoLonger) {
  const Vec3 pulled = kMiddle + Vec3(0, 0, 0.01);
  grasp_and_pull(0.01);
  const double put_in_j = -session_.given_j();
  pull_while_cut_at(0.09, pulled);
  EXPECT_LT(session_.move_to(pulled, 0.2).norm(), 0.05);
  EXPECT_LE(session_.largest_step_n(), kSlew_n);
  session_.move_to(kMiddle + Vec3(0, 0, 0.05), 0.5);
  EXPECT_LT(session_.given_j(), 0.02 * put_in_j);
  const auto hand = session_.hand_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
}

TEST(PlannedCut, ThatIsNotAtItsOrganIsRefusedWithItsFile) {
  deform::DeformOptions options;
  options.node.scene = block().scene_with("[[0, 0, 0.06]", "[[0, 0, 0.6]");
  test::FakeBus bus;
  try {
    const test::StagedLoop<deform::DeformLoop> organ(100, options, bus.opener());
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              options.node.scene.string() +
                  ": score.planned_line: found point 0 0.5 m away from the nodes of "
                  "block, expected at most 0.02 m");
  }
}

}  // namespace
}  // namespace omentum
