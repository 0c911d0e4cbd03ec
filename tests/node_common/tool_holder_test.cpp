// Whose poses move a tool.
#include "node_common/tool_holder.h"

#include <gtest/gtest.h>

namespace omentum::node {
namespace {

using enum PoseRight;

constexpr std::int64_t kMs_ns = 1'000'000, kSilence_ns = 50 * kMs_ns;
constexpr transport::WriterId kFirst{1}, kSecond{2}, kThird{3};

msg::DeviceInfo called(const std::string& name) {
  msg::DeviceInfo info{};
  info.name = name;
  return info;
}

std::string text(const DeviceName& name) {
  return name.data();
}

/// Devices that each send a pose a millisecond, in the order in which they are named.
class ToolHolderTest : public testing::Test {
 protected:
  PoseRight pose(const transport::WriterId& writer) {
    const PoseRight right = holder_.judge(transport::participant_of(writer), now_ns_, names_.known());
    if (right == kHolds || right == kTakes) holder_.heard(now_ns_);
    return right;
  }
  /// What the last of them may do after `ms`.
  PoseRight go(int ms, std::initializer_list<transport::WriterId> writers) {
    PoseRight last = kRefused;
    for (int i = 0; i < ms; ++i) {
      now_ns_ += kMs_ns;
      for (const transport::WriterId& writer : writers) last = pose(writer);
    }
    return last;
  }

  DeviceRegister names_{"omega"};
  ToolHolder holder_{kSilence_ns};
  std::int64_t now_ns_ = 0;
};

TEST_F(ToolHolderTest, TheFirstOneKeepsTheToolUntilItIsSilent) {
  EXPECT_EQ(pose(kFirst), kTakes);
  EXPECT_EQ(go(500, {kFirst, kSecond}), kRefused);
  EXPECT_EQ(holder_.last().count, 0u);
  EXPECT_EQ(go(49, {kSecond}), kRefused);
  EXPECT_EQ(go(1, {kSecond}), kTakes);
  EXPECT_EQ(go(1, {kFirst}), kRefused) << "it is the second one's now";
  EXPECT_EQ(holder_.last().count, 1u);
}

TEST_F(ToolHolderTest, ANodeThatStoodStillAndHearsAStrangerFirstLeavesTheToolWhereItIs) {
  go(10, {kFirst, kSecond});
  now_ns_ += 10 * kSilence_ns;
  EXPECT_EQ(go(500, {kSecond, kFirst}), kHolds);
  EXPECT_EQ(holder_.last().count, 0u);
}

TEST_F(ToolHolderTest, TheWantedOneTakesTheToolWhenTheLastForceHasEndedAndKeepsIt) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  EXPECT_EQ(go(100, {kFirst}), kHolds) << "it said what it is, and moves nothing";
  EXPECT_EQ(go(50, {kSecond, kFirst}), kHolds) << "nobody knows yet that it goes on coming";
  EXPECT_EQ(go(50, {kSecond, kFirst}), kWaits) << "the last hand's force shall end";
  EXPECT_EQ(go(1, {kSecond}), kTakes);
  EXPECT_EQ(go(500, {kSecond, kFirst}), kRefused);
  now_ns_ += 100 * kSilence_ns;
  EXPECT_EQ(go(500, {kFirst}), kRefused) << "it is there, its hand rests";
  EXPECT_EQ(go(1, {kSecond}), kHolds);
  EXPECT_EQ(holder_.last().count, 1u);
}

TEST_F(ToolHolderTest, AHolderThatComesAgainHasTheToolWhileTheWantedOneRests) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  for (const int silent_ms : {49, 50, 51, 200, 60'000}) {
    now_ns_ += silent_ms * kMs_ns;
    EXPECT_EQ(go(20, {kThird, kFirst}), kHolds) << "after " << silent_ms << " ms";
    EXPECT_EQ(go(100, {kFirst, kThird}), kRefused) << "it is no third one's";
  }
  EXPECT_EQ(holder_.last().count, 0u);
  now_ns_ += kSilence_ns;
  EXPECT_EQ(go(1, {kSecond}), kTakes);
  EXPECT_EQ(go(500, {kFirst}), kRefused) << "somebody took it meanwhile";
}

TEST_F(ToolHolderTest, WhenTheWantedOneLeavesTheNextOneIsTaken) {
  names_.hear(called("omega"), kFirst);
  names_.hear(called("falcon"), kSecond);
  go(100, {kFirst, kSecond});
  names_.gone(kFirst);
  EXPECT_EQ(go(52, {kSecond}), kHolds);
  EXPECT_EQ(text(holder_.last().from), "omega");
  EXPECT_EQ(text(holder_.last().to), "falcon");
}

TEST_F(ToolHolderTest, AnHeirThatIsGoneAgainInheritsNothing) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  go(70, {kFirst, kSecond});
  EXPECT_EQ(go(99, {kFirst}), kWaits);
  EXPECT_EQ(go(1, {kFirst}), kHolds);
  EXPECT_EQ(go(10, {kSecond, kFirst}), kHolds) << "one that comes again has to show it anew";
  EXPECT_EQ(holder_.last().count, 0u);
}

TEST_F(ToolHolderTest, AWantedOneTooSlowToHoldAToolDoesNotInterruptWhoHoldsIt) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(go(1, {kSecond}), i == 0 ? kWaits : kRefused)
        << "from the second one on it is known to be slow";
    for (int ms = 1; ms < 51; ++ms) ASSERT_EQ(go(1, {kFirst}), kHolds) << "pose " << i << ", " << ms << " ms";
  }
  EXPECT_EQ(holder_.last().count, 0u);
}

TEST_F(ToolHolderTest, AWantedOneThatIsJustFastEnoughTakesTheTool) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  const auto after = [&](int ms) {
    go(ms - 1, {kFirst});
    return go(1, {kSecond});
  };
  for (const int ms : {40, 40, 40}) EXPECT_EQ(after(ms), kWaits);
  EXPECT_EQ(after(60), kTakes) << "in a hand-over nobody else is heard, so that one late pose spoils none";
}

TEST_F(ToolHolderTest, AWantedOneTakesAtOnceWhatNobodyMovesHoweverSlowItIs) {
  go(500, {kFirst});
  names_.hear(called("omega"), kSecond);
  now_ns_ += kSilence_ns - 2 * kMs_ns;
  EXPECT_EQ(go(1, {kSecond}), kWaits) << "the last hand's force may not have ended";
  now_ns_ += 2 * kSilence_ns;
  EXPECT_EQ(go(1, {kSecond}), kTakes);
  EXPECT_EQ(holder_.last().count, 1u);
}

TEST_F(ToolHolderTest, OfTwoOfTheWantedNameTheFirstOneStays) {
  names_.hear(called("omega"), kFirst);
  names_.hear(called("omega"), kSecond);
  go(1, {kFirst});
  EXPECT_EQ(go(500, {kFirst, kSecond}), kRefused);
  EXPECT_EQ(go(52, {kSecond}), kHolds) << "one that came back under another number";
}

TEST_F(ToolHolderTest, OfTwoHeirsTheFirstOneTakesIt) {
  go(100, {kFirst});
  names_.hear(called("omega"), kSecond);
  names_.hear(called("omega"), kThird);
  EXPECT_EQ(go(110, {kFirst, kSecond, kThird}), kRefused);
  EXPECT_EQ(go(1, {kSecond}), kHolds);
}

TEST_F(ToolHolderTest, HoweverManyStrangersDescribeAToolTheWantedOneHasRoom) {
  for (std::uint8_t i = 0; i < 20; ++i) names_.hear(called("stranger"), {100, i});
  names_.hear(called("omega"), kSecond);
  go(1, {kFirst});
  EXPECT_EQ(go(60, {kSecond}), kHolds);
  EXPECT_EQ(go(60, {kFirst}), kRefused);
}

TEST_F(ToolHolderTest, WhereNoDeviceIsWantedNobodyIsByHavingNoName) {
  DeviceRegister nobody{""};
  nobody.hear(called(""), kSecond);
  EXPECT_FALSE(nobody.known().wants(transport::participant_of(kSecond)));
}

}  // namespace
}  // namespace omentum::node
