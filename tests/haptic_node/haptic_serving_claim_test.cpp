#include "haptic_node/serving_claim.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::haptic {
namespace {

using node::Standing;

constexpr double kRate_hz = 1000;
constexpr std::uint32_t kOwnTools = 0b0011, kShared = 0b0010;

ServingClaim own(Standing standing) {
  return {.claim = {.instance = 1000, .standing = standing}, .tools_served = kOwnTools};
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
  for (const std::uint64_t instance : {1, 2000})
    EXPECT_EQ(judge(own(Standing::kListening), other(instance, 0.1)).given_up, kShared);
}

TEST(ServingClaim, WhoIsSettledKeepsItsToolsWhateverIsClaimed) {
  msg::NodeStatus boldest = other(0, 0, ~0u);
  boldest.ticks = std::numeric_limits<std::uint64_t>::max();
  for (const msg::NodeStatus& claimant : {other(1, 2), other(1, 60), other(2000, 60), boldest}) {
    const Dispute dispute = judge(own(Standing::kSettled), claimant);
    EXPECT_EQ(dispute.given_up, 0u);
    EXPECT_EQ(dispute.kept, kOwnTools & claimant.tools_served);
  }
}

TEST(ServingClaim, WhoIsYoungYieldsToWhoIsSettledAndOnlyWhatIsInDispute) {
  EXPECT_EQ(judge(own(Standing::kYoung), other(2000, 60)).given_up, kShared) << "it was found late";
  EXPECT_EQ(judge(own(Standing::kYoung), other(1, 60, 0b1100)).given_up, 0u) << "other tools";
  EXPECT_EQ(judge(own(Standing::kYoung), other(1, 60, 0b1100)).kept, 0u);
}

// Two that started together: one of them serves each tool.
TEST(ServingClaim, OneOfTwoYoungOnesStays) {
  const ServingClaim mine = own(Standing::kYoung);
  for (const std::uint64_t instance : {1, 2000}) {
    const msg::NodeStatus theirs = other(instance, 0.5, kOwnTools);
    const ServingClaim turned{node::claim_of(theirs), kOwnTools};
    EXPECT_EQ(judge(mine, theirs).given_up ^ judge(turned, other(1000, 0.5, kOwnTools)).given_up, kOwnTools);
  }
}

TEST(ServingClaim, AnEndNamesToolAndHost) {
  const msg::NodeStatus theirs = other(1, 60);
  const std::string why = nothing_left(judge(own(Standing::kListening), theirs), theirs);
  EXPECT_NE(why.find("tool 1 is already served"), std::string::npos) << why;
  EXPECT_NE(why.find("elsewhere"), std::string::npos) << why;
}

}  // namespace
}  // namespace omentum::haptic
