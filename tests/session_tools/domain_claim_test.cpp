#include "session_tools/domain_claim.h"

#include <gtest/gtest.h>

#include <vector>

namespace omentum::session {
namespace {

DomainClaim claim_of(std::uint64_t instance, const char* host, bool held) {
  return {instance, host, held};
}

TEST(DomainClaim, EveryNodeOfASessionGoesBeforeWhoListens) {
  const DomainClaim own = claim_of(1, "here", false);
  for (const std::uint32_t kind : {msg::NODE_HAPTIC, msg::NODE_DEFORM, msg::NODE_RENDER, msg::NODE_DEVICE}) {
    msg::NodeStatus other;
    other.kind = kind;
    other.instance = own.instance;
    EXPECT_TRUE(better_claim(own, other));
  }
  msg::NodeStatus deform;
  deform.kind = msg::NODE_DEFORM;
  deform.host = "theatre-2";
  EXPECT_EQ(better_claim(own, deform), "deform_node on theatre-2");
}

TEST(DomainClaim, ItsOwnStatusIsNobodyElses) {
  for (const bool held : {false, true}) {
    const DomainClaim own = claim_of(7, "here", held);
    EXPECT_FALSE(better_claim(own, status_of(own)));
    EXPECT_FALSE(better_claim(claim_of(7, "here", false), status_of(own)));
  }
}

TEST(DomainClaim, WhatIsHeldGivesWayToNobody) {
  const DomainClaim own = claim_of(7, "here", true);
  EXPECT_FALSE(better_claim(own, status_of(claim_of(1, "there", true))));
  msg::NodeStatus haptic;
  haptic.kind = msg::NODE_HAPTIC;
  EXPECT_FALSE(better_claim(own, haptic));
}

// whatever two launchers are, and whatever their clocks say: when each hears the other, exactly one goes on
TEST(DomainClaim, OfTwoThatHearEachOtherOneStays) {
  std::vector<DomainClaim> claims;
  for (const std::uint64_t instance : {1, 2})
    for (const char* host : {"a", "b"})
      for (const bool held : {false, true}) claims.push_back(claim_of(instance, host, held));
  for (const DomainClaim& one : claims) {
    for (const DomainClaim& two : claims) {
      const bool same = one.instance == two.instance && one.host == two.host;
      if (same || (one.held && two.held)) continue;
      const bool one_yields = better_claim(one, status_of(two)).has_value();
      const bool two_yields = better_claim(two, status_of(one)).has_value();
      EXPECT_NE(one_yields, two_yields);
    }
  }
}

}  // namespace
}  // namespace omentum::session
