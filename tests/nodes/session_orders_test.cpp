#include "node/session_orders.h"

#include <gtest/gtest.h>

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

TEST(SessionOrders, AnEventThatIsSentTwiceIsObeyedOnce) {
  SessionOrders orders(kStart_ns);
  orders.hear(command(msg::COMMAND_RESET, 1));
  EXPECT_TRUE(orders.take_reset());
  orders.hear(command(msg::COMMAND_RESET, 1));
  EXPECT_FALSE(orders.take_reset());
  orders.hear(command(msg::COMMAND_RESET, 2));
  EXPECT_TRUE(orders.take_reset());
  orders.hear(command(msg::COMMAND_CLEAR_FAULT, 3));
  EXPECT_TRUE(orders.take_clear_fault());
  orders.hear(command(msg::COMMAND_CLEAR_FAULT, 3));
  EXPECT_FALSE(orders.take_clear_fault());
  EXPECT_FALSE(orders.paused());
}

TEST(SessionOrders, CopiesOfSeveralSendersMayCross) {
  SessionOrders orders(kStart_ns);
  for (const std::uint64_t seq : {10, 5}) {
    orders.hear(command(msg::COMMAND_RESET, seq));
    EXPECT_TRUE(orders.take_reset()) << seq;
  }
  for (const std::uint64_t seq : {10, 5}) {
    orders.hear(command(msg::COMMAND_RESET, seq));
    EXPECT_FALSE(orders.take_reset()) << seq;
  }
}

TEST(SessionOrders, PauseAndStartSayWhatShallBe) {
  SessionOrders orders(kStart_ns);
  for (const std::uint32_t what : {msg::COMMAND_PAUSE, msg::COMMAND_START, msg::COMMAND_PAUSE}) {
    orders.hear(command(what, 1));
    EXPECT_EQ(orders.paused(), what == msg::COMMAND_PAUSE);
  }
}

TEST(SessionOrders, WhoJoinsAPausedSessionIsPaused) {
  SessionOrders orders(kStart_ns);
  orders.hear(status(false), kSoon_ns);
  EXPECT_FALSE(orders.paused());
  orders.hear(status(true), kSoon_ns);
  EXPECT_TRUE(orders.paused());
  orders.hear(command(msg::COMMAND_START, 1));
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
