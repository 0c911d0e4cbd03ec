// The oracle that the paths are judged by: it must neither see air where a tool presses nor be fooled by a
// force that should not be there.
#include "air_oracle.h"

#include "haptic_fixtures.h"

namespace omentum::haptic_test {
namespace {

const Vec3 kOverPlate(0.06, 0.06, 0.02);

class AirOracleOnAPlate : public testing::Test {
 protected:
  bool in_air() { return oracle_.in_air(bench_.state(), !bench_.output().force.isZero(0)); }
  void SetUp() override {
    bench_.step_to(kOverPlate);
    ASSERT_TRUE(in_air());
  }
  Bench bench_{make_model(plate(), {round_tool()})};
  AirOracle oracle_{bench_.model().organs.front(), 0};
};

// 12 mm below its bottom, where a plate that does not give would be far above.
TEST_F(AirOracleOnAPlate, AToolThatPushesThePlateOutIsNotInTheAir) {
  bench_.move_to(kOverPlate - Vec3(0, 0, 0.032), 400);
  ASSERT_GT(bench_.output().force.z(), 0);
  EXPECT_FALSE(in_air());
}

TEST_F(AirOracleOnAPlate, AToolBesideThePlateIsInTheAir) {
  bench_.move_to({0.15, 0.06, 0.02}, 200);
  EXPECT_TRUE(in_air());
  bench_.move_to({0.15, 0.06, -0.02}, 200);
  EXPECT_TRUE(in_air());
}

TEST_F(AirOracleOnAPlate, AToolJustOverThePlateIsNotFarOutside) {
  bench_.move_to({0.06, 0.06, 0.002 + 0.9 * AirOracle::kMargin_m}, 200);
  EXPECT_FALSE(in_air());
}

// A contact that stayed at the plate's bottom drags it up to the tool: the tool is on the deformed surface
// then.
TEST_F(AirOracleOnAPlate, AForceThatDragsTheSurfaceAlongHidesNoAir) {
  SurfaceId node(0);
  for (SurfaceId s(0); s < plate().surface.mobile_count; s = SurfaceId(s + 1)) {
    const Vec3 below(0.06, 0.06, 0);
    if ((plate().rest[s] - below).norm() < (plate().rest[node] - below).norm()) node = s;
  }
  const double compliance = bench_.model().organs.front().compliance.block(node, node)(2, 2);
  haptic::HapticState& state = bench_.state();
  state.node_forces[0] = {haptic::BodyId(0), node, 0, Vec3(0, 0, kOverPlate.z() / compliance)};
  state.node_force_count = 1;
  PlainSurface dragged(bench_.model().organs.front());
  dragged.deform(state.forces());
  ASSERT_FALSE(dragged.clear_of(state.tools[0].now, AirOracle::kMargin_m));
  EXPECT_TRUE(oracle_.in_air(state, true));
}

}  // namespace
}  // namespace omentum::haptic_test
