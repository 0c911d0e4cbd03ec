#include "physics/dynamics/energy_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::physics {
namespace {

constexpr double kMargin = 3, kSlack_j = 1e-6, kStep_s = 0.01;

class EnergyWatchTest : public testing::Test {
 protected:
  EnergyWatch watch{kMargin, kSlack_j};
};

TEST_F(EnergyWatchTest, SlackPassesAtRest) {
  EXPECT_TRUE(watch.accepts(0.9 * kSlack_j, kStep_s));
  EXPECT_FALSE(watch.accepts(1.1 * kSlack_j, kStep_s));
}

TEST_F(EnergyWatchTest, EnergyMayGrowByWorkTimesMargin) {
  watch.restart(1);
  watch.add_work(2);
  EXPECT_TRUE(watch.accepts(8.9, kStep_s));
  EXPECT_FALSE(watch.accepts(9.1, kStep_s));
}

TEST_F(EnergyWatchTest, WhatIsNoNumberIsRefused) {
  watch.restart(1);
  EXPECT_FALSE(watch.accepts(std::numeric_limits<double>::quiet_NaN(), kStep_s));
  EXPECT_FALSE(watch.accepts(std::numeric_limits<double>::infinity(), kStep_s));
}

TEST_F(EnergyWatchTest, WorkGivenBackStillCoversTheSwingBack) {
  watch.add_work(1);
  watch.add_work(-1);
  EXPECT_TRUE(watch.accepts(0.5, kStep_s));
}

TEST_F(EnergyWatchTest, WhatDampingTookIsWrittenOff) {
  watch.restart(1);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(watch.accepts(1e-3, kStep_s));
  EXPECT_FALSE(watch.accepts(0.1, kStep_s));
}

TEST_F(EnergyWatchTest, EnergyThatIsThereIsNotAcknowledgedByBeingThere) {
  watch.restart(1);
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(watch.accepts(2.9, kStep_s));
  EXPECT_FALSE(watch.accepts(3.1, kStep_s));
}

TEST_F(EnergyWatchTest, SlowestDivergenceIsCaught) {
  watch.restart(1);
  double energy_j = 1;
  int calls = 0;
  while (watch.accepts(energy_j, kStep_s)) {
    energy_j *= 1.0001;
    ASSERT_LT(++calls, 20'000);
  }
  EXPECT_LE(energy_j, kMargin * 1.001 + kSlack_j);
}

TEST(EnergyMargin, GrowsAsSymplecticStepNearsItsLimit) {
  const ExplicitScheme scheme = ExplicitScheme::kSymplecticEuler;
  EXPECT_LT(energy_margin(scheme, 0.1), energy_margin(scheme, 0.9));
  EXPECT_GE(energy_margin(scheme, 0.9), 1.9 / 0.1);
}

}  // namespace
}  // namespace omentum::physics
