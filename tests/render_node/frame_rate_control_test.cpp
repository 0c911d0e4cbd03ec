// The control of how fine and how often frames are drawn, on load models and simulated time.
#include "render_node/frame_rate_control.h"
#include "render_node/frame_cost.h"

#include "load_models.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using test::kCoarsestLevel;
using test::kFinestLevel;
using test::LoadModel;
using test::RateSession;

constexpr double kAsked_fps = 30, kDrawingShare = 0.5;
constexpr double kMost_s = kDrawingShare / kAsked_fps;  // a frame may cost at that rate
constexpr double kReached = 0.95;
constexpr double kControlBand = 1.15;  // a level is left out that costs more than the most over this
constexpr double kTrials_s = 6;        // all means one by one

// The coarsest level fits by a quarter, the finest does not by far.
LoadModel processor_bound() {
  return {.fixed_s = 0.002, .per_piece_s = 9e-5, .per_million_pixels_s = 2e-4};
}
LoadModel vertex_bound() {
  return {.fixed_s = 0.002, .per_thousand_vertices_s = 8e-4};
}
LoadModel pixel_bound() {
  return {.fixed_s = 0.004, .per_million_pixels_s = 0.08};
}
LoadModel bound_by_all() {
  return {
      .fixed_s = 0.002, .per_piece_s = 3e-5, .per_thousand_vertices_s = 2e-4, .per_million_pixels_s = 0.03};
}

struct Case {
  const char* name;
  LoadModel load;
};
class FrameRates : public testing::TestWithParam<Case> {
 protected:
  const LoadModel& load() const { return GetParam().load; }
  static void expect_nothing_finer_reaches(const LoadModel& load, const PictureLevel& level) {
    for (std::size_t m = 0; m < kMeanCount; ++m) {
      PictureLevel finer = level;
      if (++finer.step[m] > kFinestStep[m]) continue;
      EXPECT_GT(load.cost_s(finer), kMost_s / kControlBand) << "mean " << m << " of " << words(level);
    }
  }
  /// Since a second after `from_s`, on the whole.
  void expect_rate(double from_s) const {
    EXPECT_LT(session_.settled_s(from_s, kAsked_fps, kReached), 1);
    EXPECT_GE(session_.rate(from_s + 1, session_.now_s()), kReached * kAsked_fps);
  }
  RateSession session_{kAsked_fps, kDrawingShare};
};

TEST_P(FrameRates, TheCoarsestLevelFitsAndTheFinestDoesNot) {
  EXPECT_LT(load().cost_s(kCoarsestLevel), 0.8 * kMost_s);
  EXPECT_GT(load().cost_s(kFinestLevel), 1.5 * kMost_s);
}

TEST_P(FrameRates, FromTheCoarsestTheRateIsNeverLostAndNothingFinerIsLeftUnused) {
  session_.run(load(), kTrials_s);
  expect_rate(0);
  expect_nothing_finer_reaches(load(), session_.control().level());
  EXPECT_LE(load().cost_s(session_.control().level()), kMost_s);
}

TEST_P(FrameRates, FromTheFinestItSettlesWithinASecond) {
  session_.run(LoadModel{.fixed_s = 1e-4}, kTrials_s);
  ASSERT_EQ(session_.control().level(), kFinestLevel);
  const double change_s = session_.now_s();
  session_.run(load(), kTrials_s);
  expect_rate(change_s);
  expect_nothing_finer_reaches(load(), session_.control().level());
}

TEST_P(FrameRates, ALoadThatGrowsAndFallsIsFollowed) {
  session_.run(load(), kTrials_s);
  for (const double factor : {1.25, 1.0, 0.5}) {
    const double change_s = session_.now_s();
    session_.run(load().times(factor), kTrials_s);
    expect_rate(change_s);
    expect_nothing_finer_reaches(load().times(factor), session_.control().level());
  }
}

TEST_P(FrameRates, DoesNotSwingUnderNoise) {
  constexpr double kNoise = 0.1;
  session_.run(load(), 2 * kTrials_s, kNoise);
  const std::uint64_t before = session_.control().changes();
  session_.run(load(), 25, kNoise);
  EXPECT_LE(session_.control().changes() - before, 2u) << "one trial that is refused";
  expect_rate(2 * kTrials_s);
}

INSTANTIATE_TEST_SUITE_P(Loads, FrameRates,
                         testing::Values(Case{"processor", processor_bound()},
                                         Case{"vertices", vertex_bound()}, Case{"pixels", pixel_bound()},
                                         Case{"all", bound_by_all()}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FrameRateControl, ANarrowPlaceCoarsensItsOwnMeanOnly) {
  const auto settled = [](const LoadModel& load) {
    RateSession session(kAsked_fps, kDrawingShare);
    session.run(load, kTrials_s);
    return session.control().level();
  };
  const PictureLevel few_pixels = settled(pixel_bound()), few_pieces = settled(processor_bound());
  EXPECT_LT(few_pixels.step[kPixels], kFinestStep[kPixels]);
  EXPECT_EQ(few_pixels.step[kIntervals], kFinestStep[kIntervals]);
  EXPECT_EQ(few_pixels.step[kSections], kFinestStep[kSections]);
  EXPECT_LT(few_pieces.step[kIntervals], kFinestStep[kIntervals]);
  EXPECT_EQ(few_pieces.step[kSections], kFinestStep[kSections]);
  EXPECT_EQ(few_pieces.quality(), Quality::kFine);
}

TEST(FrameRateControl, AFastMachineDrawsEverythingFinelyAtTheFullRate) {
  RateSession session(kAsked_fps, kDrawingShare);
  session.run({.fixed_s = 0.001}, 1);
  EXPECT_EQ(session.control().level(), kFinestLevel);
  EXPECT_NEAR(session.rate(0, 1), kAsked_fps, 1);
}

TEST(FrameRateControl, WhereTheCoarsestIsTooDearFramesComeLaterAndKeepTheirShareOfTheTime) {
  RateSession session(kAsked_fps, kDrawingShare);
  constexpr double kCost_s = 0.04;
  session.run({.fixed_s = kCost_s}, 4);
  EXPECT_EQ(session.control().level(), kCoarsestLevel);
  EXPECT_NEAR(session.rate(1, 4) * kCost_s, kDrawingShare, 0.05);
  EXPECT_NEAR(session.control().reached_fps(), kDrawingShare / kCost_s, 0.1);
}

TEST(FrameCost, IsTheProcessorsTimeWhereOthersHadItMeanwhile) {
  constexpr double kClock_s = 0.04;
  EXPECT_EQ(counted_cost_s(kClock_s, kClock_s, kDrawingDuty), kClock_s) << "nobody else";
  EXPECT_EQ(counted_cost_s(kClock_s, 0.9 * kClock_s, kDrawingDuty), 0.9 * kClock_s);
  EXPECT_EQ(counted_cost_s(0, 0.01, kDrawingDuty), 0) << "clocks that differ";
}

TEST(FrameCost, FramesThatWaitEndBeforeTheNextBegins) {
  constexpr double kClock_s = 0.04;
  FrameRateControl control(kAsked_fps, kDrawingDuty);
  for (int k = 0; k < 20; ++k) control.record(k * kClock_s, counted_cost_s(kClock_s, 0.01, kDrawingDuty));
  EXPECT_NEAR(control.reached_fps(), kWaitingDuty / kClock_s, 1e-6);
}

TEST(FrameRateControl, OneDelayedFrameChangesNothing) {
  RateSession session(kAsked_fps, kDrawingShare);
  session.run(bound_by_all(), kTrials_s);
  const std::uint64_t before = session.control().changes();
  for (int k = 0; k < 5; ++k) {
    session.run({.fixed_s = 5 * kMost_s}, 1e-3);
    session.run(bound_by_all(), 1);
  }
  EXPECT_EQ(session.control().changes(), before);
}

}  // namespace
}  // namespace omentum::render
