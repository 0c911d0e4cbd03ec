#include "device_bridge/answer_gate.h"

#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::device {
namespace {

using test::kMs;

constexpr std::int64_t kFirst_ns = 1'000'000 * kMs;
constexpr auto kOldest_ns = static_cast<std::int64_t>(1e9 * AnswerGate::kOldestPose_s);

// A device that has sent a pose a millisecond; pose n is stamped kFirst_ns + n ms.
struct AnswerGateTest : ::testing::Test {
  static constexpr std::uint64_t kSent = 1000;
  AnswerGateTest() {
    for (std::uint64_t seq = 1; seq <= kSent; ++seq) gate.sent(seq, stamp_ns(seq));
  }
  static std::int64_t stamp_ns(std::uint64_t seq) { return kFirst_ns + static_cast<std::int64_t>(seq) * kMs; }

  AnswerVerdict judge(std::uint64_t seq, std::uint64_t echo_seq, std::int64_t echo_stamp_ns,
                      std::int64_t now_ns) {
    msg::ToolForce answer;
    answer.seq = seq;
    answer.echo_seq = echo_seq;
    answer.echo_stamp_ns = echo_stamp_ns;
    return gate.judge(answer, now_ns);
  }
  // an answer that arrives a millisecond after its pose
  AnswerVerdict prompt(std::uint64_t seq, std::uint64_t echo_seq) {
    return judge(seq, echo_seq, stamp_ns(echo_seq), stamp_ns(echo_seq) + kMs);
  }

  AnswerGate gate;
};

TEST_F(AnswerGateTest, AcceptsAnswersToThePosesThatWereSent) {
  for (std::uint64_t i = 1; i <= 50; ++i) EXPECT_EQ(prompt(i, kSent - 50 + i), AnswerVerdict::kAccepted);
  // without a new pose the last one is answered again
  EXPECT_EQ(prompt(51, kSent), AnswerVerdict::kAccepted);
  EXPECT_EQ(gate.counts().accepted, 51u);
  EXPECT_EQ(gate.counts().lost, 0u);
}

TEST_F(AnswerGateTest, RefusesAnswersToAnotherDevicesPoses) {
  const std::int64_t now_ns = stamp_ns(kSent) + kMs;
  // of the same machine's clock and about the same count, stamped between two of ours
  EXPECT_EQ(judge(1, kSent, stamp_ns(kSent) - kMs / 2, now_ns), AnswerVerdict::kForeign);
  EXPECT_EQ(judge(2, kSent - 1, stamp_ns(kSent), now_ns), AnswerVerdict::kForeign);
  // of another count, of another clock
  EXPECT_EQ(judge(3, kSent + 1, stamp_ns(kSent + 1), now_ns), AnswerVerdict::kForeign);
  EXPECT_EQ(judge(4, kSent, std::numeric_limits<std::int64_t>::max(), now_ns), AnswerVerdict::kForeign);
  EXPECT_EQ(gate.counts().foreign, 4u);
  EXPECT_EQ(gate.counts().accepted, 0u);
}

TEST_F(AnswerGateTest, RefusesWhatWasKeptBackAndWhatAnEarlierRunSent) {
  EXPECT_EQ(judge(1, kSent, stamp_ns(kSent), stamp_ns(kSent) + kOldest_ns), AnswerVerdict::kAccepted);
  EXPECT_EQ(judge(2, kSent, stamp_ns(kSent), stamp_ns(kSent) + kOldest_ns + 1), AnswerVerdict::kLate);
  EXPECT_EQ(judge(3, kSent, kFirst_ns - 1000 * kMs, stamp_ns(kSent)), AnswerVerdict::kLate);
  EXPECT_EQ(judge(4, 0, std::numeric_limits<std::int64_t>::min(), stamp_ns(kSent)), AnswerVerdict::kLate);
  EXPECT_EQ(gate.counts().late, 3u);
}

TEST_F(AnswerGateTest, RefusesAnOlderAnswerThatArrivesAfterANewerOne) {
  EXPECT_EQ(prompt(5, 995), AnswerVerdict::kAccepted);
  EXPECT_EQ(prompt(7, 997), AnswerVerdict::kAccepted);
  EXPECT_EQ(prompt(6, 996), AnswerVerdict::kRepeated);
  EXPECT_EQ(prompt(7, 997), AnswerVerdict::kRepeated);
  EXPECT_EQ(prompt(8, 998), AnswerVerdict::kAccepted);
  EXPECT_EQ(gate.counts().lost, 1u);  // it came, but too late to be of use
  EXPECT_EQ(gate.counts().repeated, 2u);
}

TEST_F(AnswerGateTest, GapsInTheAnswersAreLostFromTheFirstOneOn) {
  prompt(5, 995);  // what came before we listened is not lost
  prompt(6, 996);
  prompt(9, 999);
  EXPECT_EQ(gate.counts().lost, 2u);
}

TEST_F(AnswerGateTest, WhatAnotherDeviceCausedIsNotLost) {
  prompt(5, 995);
  judge(6, 3, kFirst_ns + 1, stamp_ns(996));
  judge(7, kSent, stamp_ns(kSent) + 1, stamp_ns(kSent));
  prompt(8, 998);
  EXPECT_EQ(gate.counts().lost, 0u);
}

// two sessions met: the other node counts from elsewhere, and may count ahead of ours
TEST_F(AnswerGateTest, AnswersOfAnotherSessionDoNotMakeOurOwnLookRepeated) {
  constexpr std::uint64_t kFarAhead = 1'000'000;
  for (std::uint64_t i = 1; i <= 50; ++i) {
    const std::uint64_t echo_seq = kSent - 50 + i;
    EXPECT_EQ(judge(kFarAhead + i, echo_seq, stamp_ns(echo_seq) + kMs / 2, stamp_ns(echo_seq) + kMs),
              AnswerVerdict::kForeign);
    EXPECT_EQ(prompt(i, echo_seq), AnswerVerdict::kAccepted);
  }
  EXPECT_EQ(gate.counts().foreign, 50u);
  EXPECT_EQ(gate.counts().repeated, 0u);
  EXPECT_EQ(gate.counts().lost, 0u);
}

TEST_F(AnswerGateTest, ANodeThatWasRestartedIsObeyedAndNoLoss) {
  EXPECT_EQ(prompt(5000, 800), AnswerVerdict::kAccepted);
  EXPECT_EQ(prompt(1, 950), AnswerVerdict::kAccepted);  // no node starts within 100 ms
  EXPECT_EQ(prompt(2, 951), AnswerVerdict::kAccepted);
  EXPECT_EQ(gate.counts().lost, 0u);
}

TEST(AnswerGate, BeforeTheFirstPoseNothingIsAccepted) {
  AnswerGate gate;
  for (const std::int64_t now_ns : {std::int64_t{0}, kMs, kFirst_ns}) {
    msg::ToolForce answer;
    answer.seq = static_cast<std::uint64_t>(now_ns) + 1;
    EXPECT_NE(gate.judge(answer, now_ns), AnswerVerdict::kAccepted);
  }
}

}  // namespace
}  // namespace omentum::device
