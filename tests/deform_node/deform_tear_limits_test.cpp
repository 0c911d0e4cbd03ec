#include "deform_node/tear_limits.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using geometry::NodeId;
using geometry::Vec3;

constexpr double kNever = physics::TearLimits::kNever;

class TearLimitsTest : public testing::Test {
 protected:
  TearLimitsTest() {
    organ_.mesh = test::make_box_mesh(4, 1, 1, Vec3(0.4, 0.1, 0.1));
    spec_.dynamics.emplace().tears = {
        .volume_change = {}, .mean_elongation = {}, .edge_elongation = 0.5, .stress_pa = 1000};
  }
  double centre_x(std::size_t t) const {
    double x = 0;
    for (const NodeId n : organ_.mesh.tetrahedra[t]) x += organ_.mesh.positions[n].x() / 4;
    return x;
  }

  organ::Organ organ_;
  scene::OrganSpec spec_;
};

TEST_F(TearLimitsTest, WithoutRegionsTheOrgansHoldEverywhere) {
  for (const auto& limits : tear_limits_of(organ_, spec_)) {
    EXPECT_EQ(limits.edge_elongation, 0.5);
    EXPECT_EQ(limits.stress_pa, 1000);
    EXPECT_EQ(limits.volume_change, kNever);
  }
}

TEST_F(TearLimitsTest, ARegionHasItsOwnAndLeavesTheRestToTheOrgan) {
  scene::RegionSpec box, ball;
  box.box = {0.3, -1, 1, 0.1, 1, -1};  // any two corners, as organ_build takes them
  box.tears.stress_pa = 50;
  ball.ball = {0.4, 0.05, 0.05, 0.15};
  ball.tears.volume_change = 0.1;
  spec_.regions = {box, ball};
  const auto limits = tear_limits_of(organ_, spec_);
  int in_box = 0, in_ball = 0;
  for (std::size_t t = 0; t < limits.size(); ++t) {
    const bool weak = limits[t].stress_pa == 50;
    in_box += weak;
    in_ball += limits[t].volume_change == 0.1;
    EXPECT_EQ(weak, centre_x(t) > 0.1 && centre_x(t) < 0.3 && limits[t].volume_change == kNever);
    EXPECT_EQ(limits[t].edge_elongation, 0.5);
  }
  EXPECT_GT(in_box, 0);
  EXPECT_GT(in_ball, 0);
}

TEST_F(TearLimitsTest, ARegionMayBeTheMeshsLabel) {
  organ_.mesh.regions.assign(organ_.mesh.tetrahedra.size(), 1);
  organ_.mesh.regions[3] = 2;
  scene::RegionSpec labelled;
  labelled.label = 2;
  labelled.tears.stress_pa = 50;
  spec_.regions = {labelled};
  const auto limits = tear_limits_of(organ_, spec_);
  for (std::size_t t = 0; t < limits.size(); ++t) EXPECT_EQ(limits[t].stress_pa, t == 3 ? 50 : 1000);
}

}  // namespace
}  // namespace omentum::deform
