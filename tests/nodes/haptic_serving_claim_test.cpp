#include "haptic_node/serving_claim.h"

#include <gtest/gtest.h>

namespace omentum::haptic {
namespace {

constexpr double kRate_hz = 1000;

ServingClaim own(Standing standing) {
  return {.instance = 1000, .tools_served = 0b0011, .organ_hash = "abc", .standing = standing};
}

msg::NodeStatus other(std::uint64_t instance, double served_s, std::uint32_t tools = 0b0110) {
  msg::NodeStatus status{};
  status.kind = msg::NODE_HAPTIC;
  status.instance = instance;
  status.tools_served = tools;
  status.rate_hz = kRate_hz;
  status.ticks = static_cast<std::uint64_t>(served_s * kRate_hz);
  status.host = "elsewhere";
  return status;
}

TEST(ServingClaim, WhoListensYieldsToWhoServesWhateverTheClocksSay) {
  for (const std::uint64_t instance : {1, 2000}) {
    const auto why = yields_to(own(Standing::kListening), other(instance, 0.1));
    ASSERT_TRUE(why);
    EXPECT_NE(why->find("tool 1"), std::string::npos) << *why;
    EXPECT_NE(why->find("elsewhere"), std::string::npos);
  }
}

TEST(ServingClaim, ANewcomerWhoseClockIsBehindDoesNotEndWhoServes) {
  EXPECT_FALSE(yields_to(own(Standing::kSettled), other(1, 2)));
  EXPECT_TRUE(yields_to(own(Standing::kYoung), other(2000, 60))) << "it found the older one late";
}

// Every pair of standings and instances: one of the two stays, the other goes.
TEST(ServingClaim, OneOfTwoStays) {
  for (const double own_s : {0.5, 60.0}) {
    for (const double other_s : {0.5, 60.0}) {
      for (const std::uint64_t instance : {1, 2000}) {
        ServingClaim mine = own(standing_of(static_cast<std::uint64_t>(own_s * kRate_hz), kRate_hz));
        const msg::NodeStatus theirs = other(instance, other_s, mine.tools_served);
        ServingClaim turned = mine;
        turned.instance = instance;
        turned.standing = standing_of(theirs.ticks, theirs.rate_hz);
        EXPECT_NE(yields_to(mine, theirs).has_value(),
                  yields_to(turned, other(mine.instance, own_s, mine.tools_served)).has_value());
      }
    }
  }
}

TEST(ServingClaim, OwnStatusAndStrangersAreNoReasonToYield) {
  const ServingClaim listening = own(Standing::kListening);
  EXPECT_FALSE(yields_to(listening, other(1000, 60))) << "its own status";
  EXPECT_FALSE(yields_to(listening, other(1, 60, 0b1100))) << "other tools";
  msg::NodeStatus device = other(1, 60);
  device.kind = msg::NODE_DEVICE;
  EXPECT_FALSE(yields_to(listening, device));
}

TEST(ServingClaim, RefusesAnotherOrganOrProtocol) {
  const ServingClaim claim = own(Standing::kListening);
  const msg::SceneInfo same{
      .protocol = msg::PROTOCOL_VERSION, .scene = "", .organs = {{.name = "o", .hash = "abc"}}};
  EXPECT_FALSE(contradicts(claim, same));
  msg::SceneInfo wrong = same;
  wrong.organs[0].hash = "def";
  ASSERT_TRUE(contradicts(claim, wrong));
  EXPECT_NE(contradicts(claim, wrong)->find("abc"), std::string::npos);
  EXPECT_NE(contradicts(claim, wrong)->find("def"), std::string::npos);
  wrong = same;
  wrong.protocol += 1;
  EXPECT_TRUE(contradicts(claim, wrong));
  wrong = same;
  wrong.organs.clear();
  EXPECT_TRUE(contradicts(claim, wrong));
}

}  // namespace
}  // namespace omentum::haptic
