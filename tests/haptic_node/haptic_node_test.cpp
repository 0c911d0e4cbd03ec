// The real haptic_node, as a device and its neighbours see it: poses in, forces and contacts out, over either
// vendor. What it makes of them is asked of its loop (haptic_loop_test.cpp).
#include "tests/haptic_node/haptic_bench.h"
#include "tests/support/bad_starts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum {
namespace {

using geometry::Vec3;
using haptic_test::kRelative;
using haptic_test::NodeBench;
using haptic_test::vector;

class HapticNodeTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  const test::BlockScene block_ = haptic_test::block_scene();
  NodeBench bench_{block_, GetParam().first, GetParam().second};
};

TEST_P(HapticNodeTest, PressedTissueAnswersItsContactSumsUpToTheForceAndTheEndIsClean) {
  bench_.send(block_.info());
  // a contact and an unaltered force of the same tick
  std::optional<msg::ToolForce> force;
  ASSERT_TRUE(bench_.press([&] {
    force = bench_.force();
    const auto contact = bench_.contact();
    if (force->state != 0 || force->force.z == 0) return false;
    if (!contact || contact->tick != force->tick || contact->nodes.empty()) return false;
    Vec3 sum = Vec3::Zero();
    for (const msg::Vec3& f : contact->forces) sum += vector(f);
    EXPECT_LE((sum + vector(force->force)).norm(), kRelative * sum.norm());
    EXPECT_EQ(contact->cause.seq, force->echo_seq);
    EXPECT_EQ(contact->displacements.size(), contact->nodes.size());
    return true;
  })) << bench_.node().messages();
  EXPECT_GT(force->force.z, 0);
  EXPECT_LE(force->echo_seq, bench_.seq());

  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_EQ(report["dds"], GetParam().first);
  EXPECT_EQ(report["loop"]["rate_hz"], 1000);
  EXPECT_GT(report["contacts"]["ticks_in_contact"], 0);
  // a busy machine delays this device's poses, and the node says so
  const std::string slow = "tool 0: poses come less than 40 times a second";
  for (const std::string fault : report["faults"]) EXPECT_TRUE(fault.starts_with(slow)) << fault;
}

TEST_P(HapticNodeTest, AnotherOrganFileIsRefusedWithBothHashes) {
  bench_.send(block_.info("abc"));
  EXPECT_EQ(bench_.node().wait(), 2);
  EXPECT_NE(bench_.node().messages().find("abc"), std::string::npos) << bench_.node().messages();
  EXPECT_NE(bench_.node().messages().find(block_.organ_hash()), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Vendors, HapticNodeTest,
                         ::testing::Values(std::pair{"fast", transport::Vendor::kFast},
                                           std::pair{"cyclone", transport::Vendor::kCyclone},
                                           std::pair{"fast", transport::Vendor::kCyclone}),
                         [](const auto& test) {
                           return test.param.first +
                                  (test.param.second == transport::Vendor::kFast ? "ToFast" : "ToCyclone");
                         });

TEST(HapticNodeStart, BadInputIsOneLineAndExitCodeTwo) {
  test::expect_bad_starts_refused("haptic_node");
}

}  // namespace
}  // namespace omentum
