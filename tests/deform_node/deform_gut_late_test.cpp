// A gut whose node is late: a hand that holds it hears of it seldom, and of more than a period each time.
#include "tests/deform_node/gut_stage.h"

namespace omentum::deform {
namespace {

/// A tick comes every so many periods, and lives through so many.
struct LateTicks {
  int every = 1, lived = 1;
};

/// The largest force of jaws that lift a loop by 6 cm within half a second.
double largest_hold_n(const LateTicks& ticks) {
  GutModel model = gut_model({.step_s = 0.0025});
  const NodeId node = highest_node();
  HoldingHand hand(node, skin_places(model)[static_cast<std::size_t>(std::int32_t{node})]);
  hand.learn(model);
  const double period_s = 1e-3;
  double largest_n = 0;
  for (int ms = 1; ms <= 700; ++ms) {
    largest_n = std::max(largest_n, hand.hold({0, 0, 0.06 * std::min(1.0, ms / 500.0)}, period_s).norm());
    if (ms % (10 * ticks.every) != 0) continue;
    ToolLoad load = hand.load();
    load.grasps = true;
    model.step({.presses = {&load, 1}, .cuts = {}}, ticks.lived * kGutTick_s);
    hand.learn(model);
  }
  return largest_n;
}

// What a starved node looks ahead over three periods at once took the loop three times too far, and the
// hand's answer back again: forces grew tenfold.
TEST(LateGut, ALateTickIsToldNoForceThatATickInTimeIsNot) {
  const double in_time_n = largest_hold_n({});
  EXPECT_GT(in_time_n, 2);
  for (const int every : {4, 6}) EXPECT_LT(largest_hold_n({every, 3}), 1.2 * in_time_n) << every;
}

}  // namespace
}  // namespace omentum::deform
