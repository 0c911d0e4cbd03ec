#include "device_bridge/answer_book.h"

#include <gtest/gtest.h>

namespace omentum::device {
namespace {

constexpr std::int64_t kBegin_ns = 1'000'000'000;
constexpr std::int64_t kUs = 1'000;

msg::ToolForce force(std::uint32_t tool, std::uint64_t echo_seq, std::int64_t echo_stamp_ns) {
  msg::ToolForce answer;
  answer.tool = tool;
  answer.echo_seq = echo_seq;
  answer.echo_stamp_ns = echo_stamp_ns;
  return answer;
}

struct AnswerBookTest : ::testing::Test {
  AnswerBookTest() { book.serve(2); }
  AnswerBook book{kBegin_ns};
};

TEST_F(AnswerBookTest, TimesThePoseThatAnAnswerEchoes) {
  book.add(force(2, 1, kBegin_ns + 10), kBegin_ns + 10 + 80 * kUs);
  EXPECT_EQ(book.report().to_force.count, 1u);
  EXPECT_DOUBLE_EQ(book.report().to_force.max, 80);
}

TEST_F(AnswerBookTest, OnlyTheFirstAnswerToAPoseCounts) {
  // a node without a new pose goes on answering the last one
  for (int i = 0; i < 5; ++i) book.add(force(2, 1, kBegin_ns + 10), kBegin_ns + (80 + 1000 * i) * kUs);
  EXPECT_EQ(book.report().to_force.count, 1u);
  EXPECT_EQ(book.report().unanswered, 0u);
}

TEST_F(AnswerBookTest, PosesBetweenTwoAnsweredOnesAreUnanswered) {
  book.add(force(2, 5, kBegin_ns + 1),
           kBegin_ns + 9);  // what was sent before anybody answered does not count
  book.add(force(2, 6, kBegin_ns + 2), kBegin_ns + 9);
  EXPECT_EQ(book.report().unanswered, 0u);
  book.add(force(2, 9, kBegin_ns + 3), kBegin_ns + 9);
  book.add(force(2, 9, kBegin_ns + 3), kBegin_ns + 10);
  EXPECT_EQ(book.report().unanswered, 2u);
}

TEST_F(AnswerBookTest, EachToolsPosesAreCountedByThemselves) {
  book.serve(1);
  book.add(force(1, 5, kBegin_ns + 1), kBegin_ns + 9);
  book.add(force(2, 700, kBegin_ns + 1), kBegin_ns + 9);
  book.add(force(1, 6, kBegin_ns + 2), kBegin_ns + 9);
  EXPECT_EQ(book.report().unanswered, 0u);
}

TEST_F(AnswerBookTest, OtherDevicesAndEarlierRunsDoNotCount) {
  book.add(force(1, 1, kBegin_ns + 1), kBegin_ns + 9);
  book.add(force(2, 1, kBegin_ns - 1), kBegin_ns + 9);
  book.add(force(2, 2, kBegin_ns + 500), kBegin_ns + 9);  // from the future: another machine's clock
  book.add(force(99, 1, kBegin_ns + 1), kBegin_ns + 9);
  EXPECT_EQ(book.report().to_force.count, 0u);
}

TEST_F(AnswerBookTest, OrganAndPictureAreTimedByTheirNodesStatus) {
  msg::NodeStatus status;
  status.echoes = {{.tool = 2, .seq = 4, .stamp_ns = kBegin_ns + 10}};
  for (const auto kind : {msg::NODE_HAPTIC, msg::NODE_DEFORM, msg::NODE_RENDER, msg::NODE_DEVICE}) {
    status.kind = kind;
    book.add(status, kBegin_ns + 10 + (kind == msg::NODE_RENDER ? 20'000 : 5'000) * kUs);
  }
  EXPECT_DOUBLE_EQ(book.report().to_organ.max, 5'000);
  EXPECT_DOUBLE_EQ(book.report().to_picture.max, 20'000);
  EXPECT_EQ(book.report().to_organ.count, 1u);
  EXPECT_EQ(book.report().to_picture.count, 1u);
  EXPECT_EQ(book.report().to_force.count, 0u);
}

}  // namespace
}  // namespace omentum::device
