#include "deform_node/time_account.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

constexpr std::int64_t kTenth_ns = 100'000'000;
constexpr double kTolerance = 1e-9;

class TimeAccountTest : public testing::Test {
 protected:
  void pass(int tenths, double lived_per_s, bool still = false) {
    for (int i = 0; i < tenths; ++i) {
      now_ns_ += kTenth_ns;
      lived_s_ += 0.1 * lived_per_s;
      account_.note(now_ns_, lived_s_, still);
    }
  }

  TimeAccount account_;
  std::int64_t now_ns_ = 5'000'000'000;
  double lived_s_ = 0;
};

TEST_F(TimeAccountTest, WhoKeepsUpHasOne) {
  pass(30, 1);
  EXPECT_NEAR(account_.recent(), 1, kTolerance);
  EXPECT_NEAR(account_.overall(), 1, kTolerance);
}

TEST_F(TimeAccountTest, TheRecentFactorIsOfTheLastCallsAlone) {
  pass(21, 1);
  pass(10, 0.5);
  EXPECT_NEAR(account_.recent(), 0.5, kTolerance);
  EXPECT_NEAR(account_.overall(), 25.0 / 30, kTolerance);
}

TEST_F(TimeAccountTest, APauseIsNoTimeAtAll) {
  pass(11, 1);
  pass(50, 0, true);
  EXPECT_EQ(account_.recent(), 0);
  pass(5, 1);
  EXPECT_NEAR(account_.recent(), 1, kTolerance);
  EXPECT_NEAR(account_.overall(), 1, kTolerance);
}

TEST_F(TimeAccountTest, OrgansWithoutATimeOfTheirOwnHaveNoFactor) {
  EXPECT_EQ(account_.recent(), 0);
  EXPECT_EQ(account_.overall(), 0);
  pass(20, 0);
  EXPECT_EQ(account_.recent(), 0);
  EXPECT_EQ(account_.overall(), 0);
}

}  // namespace
}  // namespace omentum::deform
