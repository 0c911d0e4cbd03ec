#include "scripted_pace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace omentum::test {
namespace {

using testing::ElementsAre;

constexpr double kRate_hz = 100;
constexpr std::int64_t kPeriod_ns = 10'000'000;

class ScriptedPaceTest : public testing::Test {
 protected:
  /// A loop that notes when it ticks.
  void run() {
    pace_.run([this] {
      while (pace_.wait() != ScriptedPace::Cause::kStopped) {
        ticks_ns_.push_back(pace_.now_ns() - begin_ns_);
        if (on_tick_) on_tick_();
        pace_.finish_tick();
      }
    });
  }

  ScriptedPace pace_{kRate_hz};
  std::int64_t begin_ns_ = pace_.now_ns();
  std::vector<std::int64_t> ticks_ns_;
  std::function<void()> on_tick_;
};

TEST_F(ScriptedPaceTest, TicksWhenTheTestSaysSoAndNotBefore) {
  run();
  EXPECT_TRUE(ticks_ns_.empty());
  EXPECT_TRUE(pace_.tick(2));
  EXPECT_THAT(ticks_ns_, ElementsAre(kPeriod_ns, 2 * kPeriod_ns));
  EXPECT_TRUE(pace_.pass(0.05));
  EXPECT_EQ(ticks_ns_.back(), 7 * kPeriod_ns);
  pace_.finish();
  EXPECT_EQ(pace_.record().ticks, 7u);
  EXPECT_EQ(pace_.record().missed, 0u);
}

TEST_F(ScriptedPaceTest, ALoopThatEndsByItselfTicksNoMoreAndSaysWhy) {
  on_tick_ = [] { throw std::runtime_error("enough"); };
  run();
  EXPECT_FALSE(pace_.tick(3));
  EXPECT_EQ(ticks_ns_.size(), 1u);
  EXPECT_THROW(pace_.finish(), std::runtime_error);
  EXPECT_NO_THROW(pace_.finish()) << "it was said";
}

TEST_F(ScriptedPaceTest, AWakeIsTheNextTicksCause) {
  run();
  pace_.wake();
  pace_.tick(3);
  EXPECT_EQ(pace_.woken(), 1u);
}

TEST_F(ScriptedPaceTest, StoppedBeforeItBeganItDoesNotTick) {
  pace_.stop();
  run();
  EXPECT_FALSE(pace_.tick());
  EXPECT_TRUE(ticks_ns_.empty());
}

TEST_F(ScriptedPaceTest, WorkBesideTheLoopIsDoneWhenItIsDue) {
  std::vector<std::int64_t> done_ns;
  auto work =
      pace_.beside(std::chrono::milliseconds(20), [&] { done_ns.push_back(pace_.now_ns() - begin_ns_); });
  run();
  pace_.tick(5);
  EXPECT_THAT(done_ns, ElementsAre(2 * kPeriod_ns, 4 * kPeriod_ns));
  work.reset();
  pace_.tick(5);
  EXPECT_EQ(done_ns.size(), 2u);
}

TEST_F(ScriptedPaceTest, AStallIsTimeWithoutTicks) {
  run();
  pace_.tick();
  pace_.stall(5 * kPeriod_ns);
  pace_.tick();
  EXPECT_THAT(ticks_ns_, ElementsAre(kPeriod_ns, 7 * kPeriod_ns));
  pace_.finish();
  EXPECT_EQ(pace_.record().missed, 5u);
}

}  // namespace
}  // namespace omentum::test
