#include "node/session_orders.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace omentum::node {
namespace {

constexpr std::int64_t kStart_ns = 7'000'000'000, kSoon_ns = kStart_ns + 1'000'000'000;

msg::SessionCommand command(std::uint32_t what, std::uint64_t seq) {
  return {.seq = seq, .command = what, .argument = {}};
}

msg::NodeStatus status(bool paused) {
  msg::NodeStatus status{};
  status.kind = msg::NODE_DEVICE;
  status.paused = paused;
  return status;
}

class SessionOrdersTest : public testing::Test {
 protected:
  void hear(std::uint32_t what, std::uint64_t seq) {
    now_ns_ += kBetween_ns;
    orders_.hear(command(what, seq), now_ns_);
  }
  static constexpr std::int64_t kBetween_ns = 1'000'000;
  static constexpr std::uint64_t kNoon_ns = 1'800'000'000'000'000'000, kTenth_ns = 100'000'000;
  std::int64_t now_ns_ = kStart_ns;
  SessionOrders orders_{kStart_ns};
};

TEST_F(SessionOrdersTest, AnEventThatIsSentTwiceIsObeyedOnce) {
  for (const std::uint64_t seq : {1, 2}) {
    hear(msg::COMMAND_RESET, seq);
    EXPECT_TRUE(orders_.take_reset());
    hear(msg::COMMAND_RESET, seq);
    EXPECT_FALSE(orders_.take_reset());
  }
  hear(msg::COMMAND_CLEAR_FAULT, 3);
  EXPECT_TRUE(orders_.take_clear_fault());
  hear(msg::COMMAND_CLEAR_FAULT, 3);
  EXPECT_FALSE(orders_.take_clear_fault());
  EXPECT_FALSE(orders_.paused());
}

TEST_F(SessionOrdersTest, CopiesOfSeveralSendersMayCross) {
  for (const std::uint64_t seq : {10, 5}) {
    hear(msg::COMMAND_RESET, seq);
    EXPECT_TRUE(orders_.take_reset()) << seq;
  }
  for (const std::uint64_t seq : {10, 5}) {
    hear(msg::COMMAND_RESET, seq);
    EXPECT_FALSE(orders_.take_reset()) << seq;
  }
}

TEST_F(SessionOrdersTest, ASecondCopyDoesNotUndoWhatCameBetween) {
  for (const auto& [first, second] : {std::pair{msg::COMMAND_PAUSE, msg::COMMAND_START},
                                      std::pair{msg::COMMAND_START, msg::COMMAND_PAUSE}}) {
    hear(first, 7 + first);
    hear(second, 9 + first);
    hear(first, 7 + first);
    EXPECT_EQ(orders_.paused(), second == msg::COMMAND_PAUSE);
  }
}

// Whoever hears only some of the samples, and in whichever order, ends where the others end.
TEST_F(SessionOrdersTest, OfTwoSendersTheLaterStampHoldsForEveryNode) {
  using Sample = std::pair<std::uint32_t, std::uint64_t>;
  const Sample pause{msg::COMMAND_PAUSE, kNoon_ns}, start{msg::COMMAND_START, kNoon_ns + kTenth_ns};
  const std::vector<std::vector<Sample>> deliveries = {{pause, start},
                                                       {start, pause},
                                                       {pause, start, pause, start},
                                                       {start, pause, start, pause},
                                                       {start, start, pause}};
  for (const auto& delivery : deliveries) {
    SessionOrders orders(kStart_ns);
    for (const auto& [what, seq] : delivery) orders.hear(command(what, seq), now_ns_ += kBetween_ns);
    EXPECT_FALSE(orders.paused());
  }
}

TEST_F(SessionOrdersTest, StampsOfClocksThatAreApartHoldAsTheyCome) {
  hear(msg::COMMAND_START, kNoon_ns + 50 * kTenth_ns);
  hear(msg::COMMAND_PAUSE, kNoon_ns);
  EXPECT_TRUE(orders_.paused()) << "a machine whose clock is 5 s behind";
  hear(msg::COMMAND_START, std::numeric_limits<std::uint64_t>::max());
  hear(msg::COMMAND_PAUSE, kNoon_ns + kTenth_ns);
  EXPECT_TRUE(orders_.paused()) << "no number shuts out what comes later";
}

TEST_F(SessionOrdersTest, SendersThatCountAreHeardInTheOrderOfArrival) {
  hear(msg::COMMAND_PAUSE, 0);
  EXPECT_TRUE(orders_.paused()) << "a sender may count from zero";
  hear(msg::COMMAND_START, 40);
  EXPECT_FALSE(orders_.paused());
  hear(msg::COMMAND_PAUSE, 3);
  EXPECT_TRUE(orders_.paused()) << "another sender's count is smaller";
  now_ns_ += SessionOrders::kCopies_ns;
  hear(msg::COMMAND_START, 40);
  EXPECT_FALSE(orders_.paused()) << "a sender that starts anew counts anew";
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
