#include "deform_node/standby.h"

#include "tests/deform_node/rates.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;  // of a serving node's statuses

/// A deform_node's life in turns of one status: what it tells, what it hears.
struct Node {
  explicit Node(std::uint64_t instance) : standby(instance) {
    status.kind = msg::NODE_DEFORM;
    status.instance = instance;
    status.rate_hz = kRate_hz;
  }
  /// Whether it serves now; if so it tells.
  bool turn(std::int64_t now_ns) {
    status.ticks += static_cast<std::uint64_t>(kRate_hz / 10);
    serves = !standby.other_serves(now_ns);
    if (serves) {
      standby.serving(status);
    } else {
      standby.stepped_back();
    }
    return serves;
  }
  Standby standby;
  msg::NodeStatus status{};
  bool serves = false;
};

class StandbyTest : public testing::Test {
 protected:
  /// Both live and hear each other.
  void live(int turns) {
    for (int i = 0; i < turns; ++i) {
      one_.turn(now_ns_);
      two_.turn(now_ns_);
      if (one_.serves) two_.standby.hear(one_.status, now_ns_);
      if (two_.serves) one_.standby.hear(two_.status, now_ns_);
      now_ns_ += kPeriod_ns;
    }
  }
  void live_alone(Node& node, int turns) {
    for (int i = 0; i < turns; ++i, now_ns_ += kPeriod_ns) node.turn(now_ns_);
  }
  Node one_{1}, two_{2};
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(StandbyTest, OfTwoThatStartTogetherOneServes) {
  live(10);
  EXPECT_TRUE(one_.serves);
  EXPECT_FALSE(two_.serves);
}

TEST_F(StandbyTest, WhoMeetsAServedSceneStandsByWhateverTheClocksSay) {
  live_alone(two_, 20);
  live(1);  // the older instance has not heard of the other one yet
  one_.standby.stepped_back();
  live(10);
  EXPECT_NE(one_.serves, two_.serves);
}

TEST_F(StandbyTest, TakesOverFromWhoFellSilentAndGivesBack) {
  live(10);
  live_alone(two_, 20);
  EXPECT_TRUE(two_.serves);
  live(10);  // it was only frozen
  EXPECT_TRUE(one_.serves);
  EXPECT_FALSE(two_.serves);
}

TEST_F(StandbyTest, TwoThatMeetSettledAreOneThatServes) {
  for (Node* node : {&one_, &two_}) live_alone(*node, 100);
  live(10);
  EXPECT_TRUE(one_.serves);
  EXPECT_FALSE(two_.serves);
}

TEST_F(StandbyTest, ASampleOrABurstMovesNobodyWhoServes) {
  live_alone(two_, 100);
  one_.status.ticks = 1'000'000;
  for (int i = 0; i < 50; ++i) {
    ++one_.status.ticks;
    two_.standby.hear(one_.status, now_ns_);
  }
  EXPECT_TRUE(two_.turn(now_ns_));
}

TEST_F(StandbyTest, OtherKindsDoNotCount) {
  msg::NodeStatus haptic = one_.status;
  haptic.kind = msg::NODE_HAPTIC;
  two_.standby.hear(haptic, now_ns_);
  EXPECT_TRUE(two_.turn(now_ns_));
}

}  // namespace
}  // namespace omentum::deform
