// When deform_node serves beside another one, and when it does not: its whole loop, and two of them.
#include "tests/deform_node/deform_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace omentum::deform {
namespace {

using deform_test::DeformLoopTest;
using deform_test::kRate_hz;
using deform_test::largest;
using deform_test::push;
using testing::_;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(DeformLoopTest, StandsByBesideAnotherOneAndTakesOverWhenItFallsSilent) {
  bus_.watch<msg::SceneInfo>();
  bus_.watch<msg::OrganState>();
  bus_.post(block().info());
  const auto node = start();
  for (int second = 0; second < 4; ++second) pass_beside_another(*node);
  EXPECT_THAT(bus_.left_over(), IsEmpty()) << "it is silent";
  node->tick(90);  // the newest status came ten ticks before
  EXPECT_THAT(bus_.left_over(), IsEmpty()) << "the other one may only be late";
  bus_.expect<msg::SceneInfo>(_);
  node->tick();
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(1));
  EXPECT_EQ(node->end(), "");
}

TEST_F(DeformLoopTest, ContactsThatCameWhileItStoodByAreThereWhenItTakesOver) {
  const auto node = start();
  for (int second = 0; second < 2; ++second) pass_beside_another(*node);
  node->tick(90);
  bus_.post(push(organ(), 5));
  node->tick(5);
  EXPECT_GT(largest(*bus_.newest<msg::OrganState>()), 0);
}

TEST_F(DeformLoopTest, AServingNodeStepsBackOnlyForAClaimThatIsRepeated) {
  const auto node = serving();
  other_.ticks = 1'000'000;
  bus_.post(other_);
  ++other_.ticks;
  bus_.post(other_);
  node->tick(10);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(11)) << "two samples prove nothing";
  pass_beside_another(*node);
  bus_.take_all<msg::OrganState>();
  pass_beside_another(*node);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), IsEmpty());
  EXPECT_THAT(node->loop().report()["faults"].dump(), HasSubstr("left to it"));
}

/// Two of them, each with a pace of its own, tick by tick in turns.
class DeformPairTest : public DeformLoopTest {
 protected:
  /// In how many of the last second's ticks each of them published.
  std::pair<int, int> live(double seconds) {
    int of_one = 0, of_two = 0;
    for (int k = 0; k < std::lround(seconds * kRate_hz); ++k) {
      const bool counts = k >= std::lround((seconds - 1) * kRate_hz);
      bus_.take_all<msg::OrganState>();
      one_->tick();
      if (!bus_.take_all<msg::OrganState>().empty() && counts) ++of_one;
      two_->tick();
      if (!bus_.take_all<msg::OrganState>().empty() && counts) ++of_two;
    }
    return {of_one, of_two};
  }

  std::unique_ptr<Node> one_, two_;
};

TEST_F(DeformPairTest, OfTwoThatStartTogetherTheOlderServes) {
  one_ = start();
  two_ = start();
  EXPECT_EQ(live(3), std::pair(100, 0));
  EXPECT_EQ(one_->end(), "");
  EXPECT_EQ(two_->end(), "");
}

TEST_F(DeformPairTest, TheSecondTakesOverFromOneThatEndedHoweverItEnded) {
  one_ = start();
  one_->pass(8);
  two_ = start();
  EXPECT_EQ(live(3), std::pair(100, 0));
  one_->end();
  two_->pass(1.2);
  bus_.take_all<msg::OrganState>();
  two_->pass(1);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(100));
}

// A laptop's lid: the other one has served meanwhile, and both think that the scene is theirs.
TEST_F(DeformPairTest, WhoWasFrozenAndWhoTookOverAreOneThatServes) {
  one_ = start();
  one_->pass(8);
  two_ = start();
  live(3);
  two_->pass(10);
  one_->pace().stall(10'000'000'000);
  const auto [of_one, of_two] = live(4);
  EXPECT_TRUE((of_one == 100 && of_two == 0) || (of_one == 0 && of_two == 100)) << of_one << ' ' << of_two;
  EXPECT_EQ(one_->end(), "");
  EXPECT_EQ(two_->end(), "");
}

}  // namespace
}  // namespace omentum::deform
