#include "haptic_node/serving_claim.h"

#include <gtest/gtest.h>

namespace omentum::haptic {
namespace {

const ServingClaim kOwn{.instance = 1000, .tools_served = 0b0011, .organ_hash = "abc"};

msg::NodeStatus other(std::uint32_t kind, std::uint64_t instance, std::uint32_t tools) {
  msg::NodeStatus status{};
  status.kind = kind;
  status.instance = instance;
  status.tools_served = tools;
  status.host = "elsewhere";
  return status;
}

TEST(ServingClaim, TheYoungerOfTwoWithACommonToolYields) {
  const auto why = yields_to(kOwn, other(msg::NODE_HAPTIC, 999, 0b0110));
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("tool 1"), std::string::npos) << *why;
  EXPECT_NE(why->find("elsewhere"), std::string::npos);
}

TEST(ServingClaim, OlderOwnAndStrangersAreNoReasonToYield) {
  EXPECT_FALSE(yields_to(kOwn, other(msg::NODE_HAPTIC, 1001, 0b0011)));
  EXPECT_FALSE(yields_to(kOwn, other(msg::NODE_HAPTIC, 1000, 0b0011))) << "its own status";
  EXPECT_FALSE(yields_to(kOwn, other(msg::NODE_HAPTIC, 1, 0b1100))) << "other tools";
  EXPECT_FALSE(yields_to(kOwn, other(msg::NODE_DEVICE, 1, 0b0011)));
}

TEST(ServingClaim, RefusesAnotherOrganOrProtocol) {
  const msg::SceneInfo same{
      .protocol = msg::PROTOCOL_VERSION, .scene = "", .organs = {{.name = "o", .hash = "abc"}}};
  EXPECT_FALSE(contradicts(kOwn, same));
  msg::SceneInfo wrong = same;
  wrong.organs[0].hash = "def";
  ASSERT_TRUE(contradicts(kOwn, wrong));
  EXPECT_NE(contradicts(kOwn, wrong)->find("abc"), std::string::npos);
  EXPECT_NE(contradicts(kOwn, wrong)->find("def"), std::string::npos);
  wrong = same;
  wrong.protocol += 1;
  EXPECT_TRUE(contradicts(kOwn, wrong));
  wrong = same;
  wrong.organs.clear();
  EXPECT_TRUE(contradicts(kOwn, wrong));
}

}  // namespace
}  // namespace omentum::haptic
