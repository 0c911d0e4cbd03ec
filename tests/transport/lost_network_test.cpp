// A network that is down: a peer's, or our own.
#include "tests/transport/peer_process.h"
#include "transport/bus.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace omentum::transport {
namespace {

/// In a network of this process' own, of two ends of a cable.
class LostNetwork : public testing::TestWithParam<Vendor> {
 protected:
  void SetUp() override {
    if (unshare(CLONE_NEWNET) != 0) GTEST_SKIP() << "a network of one's own needs root's rights";
    for (const char* command : {"link set lo up", "link add here type veth peer name there",
                                "address add 10.9.9.1/24 dev here", "link set here up", "link set there up"})
      if (!ip(command)) GTEST_SKIP() << "'ip " << command << "' is not possible here";
  }

  static bool ip(const std::string& what) {
    return std::system(("ip " + what + " 2>/dev/null").c_str()) == 0;
  }
  static std::unique_ptr<Bus> open() {
    return Bus::open({.vendor = GetParam(),
                      .domain = test::domain_of_test(),
                      .profile = Profile::kLan,
                      .name = "lost_network"});
  }
};

TEST_P(LostNetwork, APeerThatCannotBeReachedIsToldOnceAtMost) {
  setenv("OMENTUM_DDS_PEERS", "172.16.0.1", 1);
  testing::internal::CaptureStderr();
  {
    const auto bus = open();
    const auto poses = bus->writer<msg::ToolPose>();
    // several announcements
    for (int look = 0; look < 200; ++look) {
      poses->write({});
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::count(told.begin(), told.end(), '\n'), 1) << told;
  const bool says_so = told.find("172.16.0.1 cannot be reached") != std::string::npos;
  EXPECT_EQ(says_so, GetParam() == Vendor::kCyclone) << told;
}

// a test that never ends when it fails
TEST_P(LostNetwork, ABusWhoseOwnInterfaceIsDownEnds) {
  auto bus = open();
  const auto poses = bus->writer<msg::ToolPose>();
  ASSERT_TRUE(ip("link set here down"));
  poses->write({});
}

INSTANTIATE_TEST_SUITE_P(Vendors, LostNetwork, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

}  // namespace
}  // namespace omentum::transport
