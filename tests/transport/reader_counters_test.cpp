#include "transport/reader_counters.h"

#include <gtest/gtest.h>

namespace omentum::transport {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr KeyValue kFirst{0}, kSecond{1};

TEST(DeadlineCounter, CountsWholePeriodsBetweenSamples) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  counter.arrived(kFirst, 0);
  counter.arrived(kFirst, 39 * kMs);
  EXPECT_EQ(counter.missed(39 * kMs), 0U);
  counter.arrived(kFirst, 129 * kMs);
  EXPECT_EQ(counter.missed(129 * kMs), 2U);
}

TEST(DeadlineCounter, CountsOnWhileNothingComes) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  EXPECT_EQ(counter.missed(1000 * kMs), 0U) << "nobody has sent yet";
  counter.arrived(kFirst, 1000 * kMs);
  EXPECT_EQ(counter.missed(1040 * kMs), 1U);
  EXPECT_EQ(counter.missed(1080 * kMs), 2U);
  counter.arrived(kFirst, 1085 * kMs);
  EXPECT_EQ(counter.missed(1085 * kMs), 2U) << "a gap is counted once";
}

TEST(DeadlineCounter, OneKeyDoesNotSpeakForAnother) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  counter.arrived(kFirst, 0);
  counter.arrived(kSecond, 0);
  for (std::int64_t now = 10 * kMs; now <= 100 * kMs; now += 10 * kMs) counter.arrived(kFirst, now);
  EXPECT_EQ(counter.missed(100 * kMs), 2U);
}

TEST(DeadlineCounter, KeysWithoutEndAreNotRemembered) {
  DeadlineCounter counter(std::chrono::milliseconds(1));
  for (std::uint64_t key = 0; key < 1000; ++key) counter.arrived({key, 0}, 0);
  EXPECT_LT(counter.missed(kMs), 1000U);
}

TEST(KeyValue, HoldsTheKeyMembersOnly) {
  EXPECT_EQ(key_value(msg::ToolPose{.tool = 3, .seq = 9}), (KeyValue{3, 0}));
  EXPECT_EQ(key_value(msg::NodeStatus{.kind = 1, .instance = 77}), (KeyValue{1, 77}));
  EXPECT_EQ(key_value(msg::SceneInfo{.protocol = 1}), (KeyValue{0, 0}));
}

}  // namespace
}  // namespace omentum::transport
