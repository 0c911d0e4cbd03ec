#include "runtime/wake_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace omentum::runtime {
namespace {

using Open = WakeGate::Open;
constexpr std::int64_t kUs = 1'000;
constexpr std::int64_t kPeriod_ns = 1'000 * kUs;

struct Tick {
  std::int64_t at_ns;
  Open cause;
};

// Plays a loop with ticks of no length against wakes at given (ascending) times, without sleeping.
std::vector<Tick> play(const std::vector<std::int64_t>& wakes, std::int64_t end_ns) {
  WakeGate gate(kPeriod_ns);
  std::vector<Tick> ticks;
  std::size_t arrived = 0;
  for (std::int64_t now = 0; now < end_ns;) {
    while (arrived < wakes.size() && wakes[arrived] <= now) ++arrived;
    const std::int64_t last = arrived > 0 ? wakes[arrived - 1] : 0;
    const Open open = gate.poll(static_cast<std::uint32_t>(arrived), last, now);
    if (open != Open::kNo) {
      ticks.push_back({now, open});
      continue;
    }
    const std::int64_t next_wake = arrived < wakes.size() ? wakes[arrived] : end_ns;
    now = std::min(next_wake, gate.ask_again_ns());
  }
  return ticks;
}

// Wakes of `tools` devices: one burst a period, `spacing` apart.
std::vector<std::int64_t> bursts(int periods, int tools, std::int64_t spacing) {
  std::vector<std::int64_t> wakes;
  for (int k = 1; k <= periods; ++k) {
    for (int tool = 0; tool < tools; ++tool) wakes.push_back(k * kPeriod_ns + tool * spacing);
  }
  return wakes;
}

TEST(WakeGate, WithoutWakesTicksComeEveryPeriodWithoutDrift) {
  const auto ticks = play({}, 100 * kPeriod_ns);
  ASSERT_EQ(ticks.size(), 99u);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i].at_ns, static_cast<std::int64_t>(i + 1) * kPeriod_ns);
    EXPECT_EQ(ticks[i].cause, Open::kSchedule);
  }
}

TEST(WakeGate, OneToolIsServedTheMomentItsPoseArrives) {
  const auto wakes = bursts(50, 1, 0);
  const auto ticks = play(wakes, 51 * kPeriod_ns);
  ASSERT_EQ(ticks.size(), wakes.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].at_ns, wakes[i]);
}

TEST(WakeGate, TwoToolsOfOnePeriodMakeOneTickWhenTheSecondArrives) {
  const std::int64_t spacing = 60 * kUs;
  const auto ticks = play(bursts(50, 2, spacing), 51 * kPeriod_ns);
  // the first burst teaches its size with one extra tick
  ASSERT_EQ(ticks.size(), 51u);
  for (std::size_t i = 2; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i].at_ns, static_cast<std::int64_t>(i) * kPeriod_ns + spacing);
    EXPECT_EQ(ticks[i].cause, Open::kWoken);
  }
}

TEST(WakeGate, AToolThatFallsSilentCostsOneShortWait) {
  auto wakes = bursts(10, 2, 60 * kUs);
  for (int k = 11; k <= 20; ++k) wakes.push_back(k * kPeriod_ns);
  const auto ticks = play(wakes, 21 * kPeriod_ns);
  ASSERT_EQ(ticks.size(), 21u);
  EXPECT_EQ(ticks[11].at_ns, 11 * kPeriod_ns + kPeriod_ns / 8);
  for (std::size_t i = 12; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i].at_ns, static_cast<std::int64_t>(i) * kPeriod_ns);
  }
}

TEST(WakeGate, DevicesOutOfStepAreEachServedAtOnce) {
  const auto wakes = bursts(50, 2, 400 * kUs);
  const auto ticks = play(wakes, 50 * kPeriod_ns + kPeriod_ns / 2);
  ASSERT_EQ(ticks.size(), wakes.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].at_ns, wakes[i]);
}

TEST(WakeGate, AWakeThatComesWhileTheLoopIsBusyIsNotLost) {
  WakeGate gate(kPeriod_ns);
  EXPECT_EQ(gate.poll(1, 0, 0), Open::kWoken);
  // the second tool's pose arrived during that tick, which took 300 us
  EXPECT_EQ(gate.poll(2, 60 * kUs, 300 * kUs), Open::kWoken);
  EXPECT_EQ(gate.poll(2, 60 * kUs, 301 * kUs), Open::kNo);
}

TEST(WakeGate, TheScheduleResumesOneAndAHalfPeriodsAfterTheLastWake) {
  const auto ticks = play({5 * kPeriod_ns + 300 * kUs}, 10 * kPeriod_ns);
  ASSERT_EQ(ticks[5].cause, Open::kWoken);
  const std::int64_t resumed = 5 * kPeriod_ns + 300 * kUs + kPeriod_ns * 3 / 2;
  EXPECT_EQ(ticks[6].at_ns, resumed);
  EXPECT_EQ(ticks[7].at_ns, resumed + kPeriod_ns);
  EXPECT_EQ(ticks[7].cause, Open::kSchedule);
}

TEST(WakeGate, PeriodsThatPassedDuringALongTickAreNotMadeUpFor) {
  WakeGate gate(kPeriod_ns);
  EXPECT_EQ(gate.poll(0, 0, 0), Open::kNo);
  EXPECT_EQ(gate.poll(0, 0, 7 * kPeriod_ns + 1), Open::kSchedule);
  EXPECT_EQ(gate.poll(0, 0, 7 * kPeriod_ns + 2), Open::kNo);
  EXPECT_EQ(gate.ask_again_ns(), 8 * kPeriod_ns);
}

TEST(WakeGate, ThePosesThatPiledUpBeforeAStalledLoopMakeOneTick) {
  WakeGate gate(kPeriod_ns);
  EXPECT_EQ(gate.poll(1, 0, 0), Open::kWoken);
  EXPECT_EQ(gate.poll(7, 5 * kPeriod_ns, 6 * kPeriod_ns), Open::kWoken);
  EXPECT_EQ(gate.poll(7, 5 * kPeriod_ns, 6 * kPeriod_ns + 1), Open::kNo);
  // and does not make the next pose wait
  EXPECT_EQ(gate.poll(8, 7 * kPeriod_ns, 7 * kPeriod_ns), Open::kWoken);
}

}  // namespace
}  // namespace omentum::runtime
