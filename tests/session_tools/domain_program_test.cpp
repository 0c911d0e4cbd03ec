// Two launchers on one network, each with a claim of its own.
#include "tests/transport/peer_process.h"

#include <gtest/gtest.h>

#include <vector>

namespace omentum {
namespace {

using test::comes_true;

class DomainProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_lan()) GTEST_SKIP() << "no interface but lo is up and does multicast, which `lan` needs";
  }
  std::unique_ptr<test::Process> claim(const char* dds) {
    return std::make_unique<test::Process>(
        "omentum_domain", std::vector<std::string>{"--domain", std::to_string(domain), "--dds", dds});
  }

  int domain = test::domain_of_test();
};

TEST_F(DomainProgram, OfTwoAtOnceOneHoldsTheDomainAndTheOtherNamesIt) {
  const auto first = claim("cyclone"), second = claim("fast");
  ASSERT_TRUE(comes_true([&] { return !first->output().empty() && !second->output().empty(); }));
  const auto& holder = first->output() == "free\n" ? first : second;
  const auto& other = first->output() == "free\n" ? second : first;
  EXPECT_EQ(holder->output(), "free\n");
  EXPECT_EQ(other->output().rfind("used by a launcher", 0), 0U) << other->output();
  EXPECT_EQ(other->wait(), 0);
  EXPECT_TRUE(holder->running());
  EXPECT_EQ(holder->terminate(), 0);
}

TEST_F(DomainProgram, ASessionThatRunsIsFound) {
  const auto bus = transport::Bus::open({.vendor = transport::Vendor::kFast,
                                         .domain = domain,
                                         .profile = transport::Profile::kLan,
                                         .name = "domain_program_test"});
  const auto status = bus->writer<msg::NodeStatus>();
  msg::NodeStatus haptic;
  haptic.kind = msg::NODE_HAPTIC;
  haptic.host = "theatre-2";
  ASSERT_TRUE(status->write(haptic));
  const auto newcomer = claim("cyclone");
  EXPECT_EQ(newcomer->wait(), 0);
  EXPECT_EQ(newcomer->output(), "used by haptic_node on theatre-2\n");
}

}  // namespace
}  // namespace omentum
