// An endoscope beside an instrument: it is followed, feels nothing, and no other hand feels it.
#include "haptic_fixtures.h"

namespace omentum::haptic_test {
namespace {

const Vec3 kScopePlace_W(0.047, 0.052, 0.04);

haptic::ToolModel touchless_scope() {
  haptic::ToolModel scope;
  scope.trocar = Vec3(0.05, -0.1, 0.2);
  return scope;
}

TEST(HapticScope, AScopeInsideTissueHasNoForceAndNoContacts) {
  Bench bench(make_model(block(), {needle(), touchless_scope()}));
  bench.place(1, kScopePlace_W + Vec3(0, 0, 0.03));
  for (int tick = 0; tick < 60; ++tick) {
    bench.place(1, kScopePlace_W + Vec3(0, 0, 0.03 - 1e-3 * tick)).step();
    ASSERT_EQ(bench.result().contacts, 0);
    ASSERT_EQ(bench.result().neighbourhood, 0) << "no surface is evaluated around it";
    ASSERT_TRUE(bench.output(1).force.isZero(0) && bench.output(1).torque.isZero(0));
  }
  EXPECT_TRUE(bench.state().tools[1].engaged);
}

TEST(HapticScope, AnotherHandFeelsTheSameWithAndWithoutAScopeInItsWay) {
  Bench alone(make_model(block(), {needle()})), beside(make_model(block(), {needle(), touchless_scope()}));
  double most_n = 0;
  for (int tick = 0; tick < 100; ++tick) {
    const Vec3 tip = kScopePlace_W + Vec3(0, 0, 0.004 - 1e-4 * tick);
    beside.place(1, tip + Vec3(0.0005, 0, 0));  // dives into the dent that the other one presses
    const Vec3 felt = beside.step_to(tip), expected = alone.step_to(tip);
    ASSERT_EQ(felt, expected) << tick;
    most_n = std::max(most_n, expected.norm());
  }
  EXPECT_GT(most_n, 0.1) << "it pressed";
}

}  // namespace
}  // namespace omentum::haptic_test
