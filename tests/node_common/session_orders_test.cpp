#include "node_common/session_orders.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace omentum::node {
namespace {

constexpr std::int64_t kStart_ns = 7'000'000'000, kSoon_ns = kStart_ns + 1'000'000'000;
constexpr std::uint64_t kAnn = 11, kBen = 22;  // two senders
constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();

msg::SessionCommand command(std::uint32_t what, std::uint64_t order, std::uint64_t sender = kAnn) {
  return {.order = order, .sender = sender, .command = what, .argument = {}};
}

msg::NodeStatus status(bool paused, std::uint64_t newest_order = 0) {
  msg::NodeStatus status{};
  status.kind = msg::NODE_DEVICE;
  status.paused = paused;
  status.newest_order = newest_order;
  return status;
}

class SessionOrdersTest : public testing::Test {
 protected:
  void hear(const msg::SessionCommand& command) {
    now_ns_ += kBetween_ns;
    orders_.hear(command, now_ns_);
  }
  void hear(std::uint32_t what, std::uint64_t order, std::uint64_t sender = kAnn) {
    hear(command(what, order, sender));
  }
  static constexpr std::int64_t kBetween_ns = 1'000'000;
  std::int64_t now_ns_ = kStart_ns;
  SessionOrders orders_{kStart_ns};
};

TEST_F(SessionOrdersTest, AnEventThatIsSentTwiceIsObeyedOnce) {
  for (const std::uint64_t order : {1, 2}) {
    hear(msg::COMMAND_RESET, order);
    EXPECT_TRUE(orders_.take_reset());
    hear(msg::COMMAND_RESET, order);
    EXPECT_FALSE(orders_.take_reset());
  }
  hear(msg::COMMAND_CLEAR_FAULT, 3);
  EXPECT_TRUE(orders_.take_clear_fault());
  hear(msg::COMMAND_CLEAR_FAULT, 3);
  EXPECT_FALSE(orders_.take_clear_fault());
  EXPECT_FALSE(orders_.paused());
}

TEST_F(SessionOrdersTest, ToRecordIsAskedForByAWordAndOnce) {
  EXPECT_FALSE(orders_.take_record());
  std::uint64_t order = 0;
  for (const auto& [argument, meant] :
       {std::pair(kRecordOn, RecordOrder::kOn), std::pair(kRecordOff, RecordOrder::kOff),
        std::pair("", RecordOrder::kToggle)}) {
    msg::SessionCommand record = command(msg::COMMAND_RECORD, ++order);
    record.argument = argument;
    hear(record);
    EXPECT_EQ(orders_.take_record(), meant);
    hear(record);
    EXPECT_FALSE(orders_.take_record()) << "a copy";
  }
  EXPECT_FALSE(orders_.paused());
}

TEST_F(SessionOrdersTest, CopiesOfSeveralSendersMayCross) {
  for (const std::uint64_t sender : {kBen, kAnn}) {
    hear(msg::COMMAND_RESET, 5, sender);
    EXPECT_TRUE(orders_.take_reset()) << "of one order, and yet two commands";
  }
  for (const std::uint64_t sender : {kBen, kAnn}) {
    hear(msg::COMMAND_RESET, 5, sender);
    EXPECT_FALSE(orders_.take_reset());
  }
}

TEST_F(SessionOrdersTest, ASecondCopyDoesNotUndoWhatCameBetween) {
  std::uint64_t order = 0;
  for (const auto& [first, second] : {std::pair{msg::COMMAND_PAUSE, msg::COMMAND_START},
                                      std::pair{msg::COMMAND_START, msg::COMMAND_PAUSE}}) {
    hear(first, ++order);
    hear(second, ++order);
    hear(first, order - 1);
    EXPECT_EQ(orders_.paused(), second == msg::COMMAND_PAUSE);
  }
}

// Whoever hears only some of the samples, and in whichever order, ends where the others end: one sender had
// heard the other, or neither had and the larger name decides.
TEST_F(SessionOrdersTest, OfTwoSendersTheLaterOrderHoldsForEveryNode) {
  const auto pause = command(msg::COMMAND_PAUSE, 8, kBen);
  for (const auto& start : {command(msg::COMMAND_START, 9, kAnn), command(msg::COMMAND_START, 8, kBen + 1)}) {
    const std::vector<std::vector<msg::SessionCommand>> deliveries = {{pause, start},
                                                                      {start, pause},
                                                                      {pause, start, pause, start},
                                                                      {start, pause, start, pause},
                                                                      {start, start, pause}};
    for (const auto& delivery : deliveries) {
      SessionOrders orders(kStart_ns);
      for (const msg::SessionCommand& sample : delivery) orders.hear(sample, now_ns_ += kBetween_ns);
      EXPECT_FALSE(orders.paused());
    }
  }
}

TEST_F(SessionOrdersTest, ACommandIsLaterThanAllThatItsSenderHeardOf) {
  hear(msg::COMMAND_RESET, 4);
  EXPECT_EQ(orders_.newest_order(), 4u);
  orders_.hear(status(false, 40), now_ns_);
  const msg::SessionCommand first = orders_.issue(msg::COMMAND_PAUSE, kBen);
  EXPECT_EQ(first, command(msg::COMMAND_PAUSE, 41, kBen));
  EXPECT_EQ(orders_.issue(msg::COMMAND_START, kBen).order, 42u) << "before its own sample came back";
  hear(msg::COMMAND_RESET, 3);
  orders_.hear(status(false, 5), now_ns_);
  EXPECT_EQ(orders_.newest_order(), 42u);
}

// omentum_session lives for a second, and knows nothing but what the nodes tell.
TEST_F(SessionOrdersTest, AShortLivedSenderThatListensIsLater) {
  hear(msg::COMMAND_PAUSE, 70, kBen);
  msg::NodeStatus told = status(false);
  orders_.tell(told);
  EXPECT_TRUE(told.paused);
  SessionOrders sender(now_ns_);
  sender.hear(told, now_ns_);
  hear(sender.issue(msg::COMMAND_START, kAnn));
  EXPECT_FALSE(orders_.paused());
}

TEST_F(SessionOrdersTest, NoNumberShutsOutWhatComesLater) {
  hear(msg::COMMAND_START, kLast, kLast);
  hear(msg::COMMAND_PAUSE, 3);
  EXPECT_FALSE(orders_.paused()) << "they may have crossed";
  now_ns_ += SessionOrders::kCrossing_ns;
  hear(msg::COMMAND_PAUSE, 4);
  EXPECT_TRUE(orders_.paused());
  EXPECT_EQ(orders_.issue(msg::COMMAND_START, kAnn).order, kLast) << "and does not begin again at none";
}

TEST_F(SessionOrdersTest, WhoNeverListensIsHeardOnceNothingCanHaveCrossed) {
  hear(msg::COMMAND_PAUSE, 0);
  EXPECT_TRUE(orders_.paused()) << "a sender may count from zero";
  hear(msg::COMMAND_START, 40);
  EXPECT_FALSE(orders_.paused());
  now_ns_ += SessionOrders::kCrossing_ns;
  hear(msg::COMMAND_PAUSE, 3, kBen);
  EXPECT_TRUE(orders_.paused()) << "another sender's count is smaller";
  now_ns_ += SessionOrders::kCopies_ns;
  hear(msg::COMMAND_START, 40);
  EXPECT_FALSE(orders_.paused()) << "a sender that starts anew counts anew";
}

TEST_F(SessionOrdersTest, WhoAlwaysWritesTheSameHoldsInTheOrderOfArrival) {
  hear(msg::COMMAND_PAUSE, 0, 0);
  EXPECT_TRUE(orders_.paused());
  hear(msg::COMMAND_START, 0, 0);
  EXPECT_FALSE(orders_.paused());
}

TEST(SessionOrders, WhoJoinsAPausedSessionIsPaused) {
  SessionOrders orders(kStart_ns);
  orders.hear(status(false), kSoon_ns);
  EXPECT_FALSE(orders.paused());
  orders.hear(status(true), kSoon_ns);
  EXPECT_TRUE(orders.paused());
  orders.hear(command(msg::COMMAND_START, 1), kSoon_ns);
  EXPECT_FALSE(orders.paused());
  orders.hear(status(true), kSoon_ns);
  EXPECT_FALSE(orders.paused()) << "an older status of a node that did not hear the command yet";
}

TEST(SessionOrders, LaterOnlyCommandsCount) {
  SessionOrders orders(kStart_ns);
  orders.hear(status(true), kStart_ns + SessionOrders::kJoining_ns + 1);
  EXPECT_FALSE(orders.paused());
}

}  // namespace
}  // namespace omentum::node
