// Runs in which nothing may pass through anything.
#include "organ_tools/intestine_soak/soak_run.h"

#include "geometry/gut_anatomy.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace omentum::intestine_soak {
namespace {

using testing::HasSubstr;

TEST(IntestineSoak, NothingPassesThroughAnythingHoweverViolentTheMotion) {
  const SoakReport report = run_violently(geometry::make_gut({}), 1e7, 7);
  EXPECT_EQ(report.crossings, 0);
  EXPECT_GE(report.pairs, 10'000'000);
  EXPECT_GT(report.bound_acted, 10'000);
  EXPECT_TRUE(report.holds());
}

TEST(IntestineSoak, AGutThatIsPulledAndStirredPassesThroughNothing) {
  const SoakReport report = run_long(geometry::make_gut({}), {.seconds = 3, .seed = 2});
  EXPECT_EQ(report.steps, 1200);
  EXPECT_EQ(report.crossings, 0);
  EXPECT_EQ(report.left_out, 0);
  EXPECT_FALSE(report.diverged);
  EXPECT_LT(report.most_j, 50);
}

TEST(IntestineSoak, ACrossingADivergenceAndAGrowingListDoNotHold) {
  const SoakReport good{.early_pairs = 100, .most_pairs = 120};
  EXPECT_TRUE(good.holds());
  SoakReport crossed = good, diverged = good, grown = good;
  crossed.crossings = 1;
  diverged.diverged = true;
  grown.most_pairs = 200;
  for (const SoakReport& bad : {crossed, diverged, grown}) EXPECT_FALSE(bad.holds());
}

TEST(IntestineSoak, PrintsItsFiguresAndRefusesWhatCannotBe) {
  test::Process process("intestine_soak", {"--minutes", "0.005", "--pair-steps", "1e5"});
  ASSERT_EQ(process.wait(), 0) << process.messages();
  EXPECT_THAT(process.output(), HasSubstr("crossings/long"));
  EXPECT_THAT(process.output(), HasSubstr("crossings/violent"));
  test::Process wrong("intestine_soak", {"--minutes", "-1"});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_EQ(std::ranges::count(wrong.messages(), '\n'), 1);
}

}  // namespace
}  // namespace omentum::intestine_soak
