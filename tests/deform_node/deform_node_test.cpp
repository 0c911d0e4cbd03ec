// The real deform_node, as its neighbours see it: Contact in, OrganState out, over either vendor. What it
// makes of them is asked of its loop (deform_loop_test.cpp).
#include "organ/organ.h"
#include "transport/bus.h"

#include "tests/deform_node/deform_push.h"
#include "tests/support/bad_starts.h"
#include "tests/support/block_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <mutex>
#include <optional>

namespace omentum {
namespace {

using deform_test::difference_from_plain_sum;
using deform_test::kWithin;
using deform_test::largest;
using deform_test::push;

/// deform_node, and what it publishes.
class Bench {
 public:
  Bench(const test::BlockScene& scene, const std::string& node_vendor, transport::Vendor own)
      : domain_(test::domain_of_test()),
        node_("deform_node", {"--scene", scene.scene(), "--dds", node_vendor, "--domain",
                              std::to_string(domain_), "--report", scene.report()}),
        bus_(transport::Bus::open({.vendor = own, .domain = domain_, .name = "test"})),
        contacts_(bus_->writer<msg::Contact>()),
        other_scenes_(bus_->writer<msg::SceneInfo>()),
        states_(bus_->reader<msg::OrganState>([this](const msg::OrganState& s) { keep(state_, s); })),
        scenes_(bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& s) { keep(scene_, s); })),
        topologies_(bus_->reader<msg::Topology>([this](const msg::Topology& t) { keep(topology_, t); })),
        statuses_(bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& s) {
          if (s.kind == msg::NODE_DEFORM) keep(status_, s);
        })) {}

  std::optional<msg::OrganState> state() { return get(state_); }
  std::optional<msg::SceneInfo> scene() { return get(scene_); }
  std::optional<msg::Topology> topology() { return get(topology_); }
  std::optional<msg::NodeStatus> status() { return get(status_); }
  test::Process& node() { return node_; }

  void send(const msg::Contact& contact) { contacts_->write(contact); }
  void send(const msg::SceneInfo& scene) { other_scenes_->write(scene); }
  std::unique_ptr<transport::Reader<msg::OrganStress>> read_stress(
      std::function<void(const msg::OrganStress&)> take) {
    return bus_->reader<msg::OrganStress>(std::move(take));
  }

  /// Sends the contact, as often as haptic_node might, until a state with its echo comes back.
  std::optional<msg::OrganState> answer_to(const msg::Contact& contact) {
    std::optional<msg::OrganState> answer;
    const bool came = test::comes_true([&] {
      send(contact);
      answer = state();
      return answer && !answer->echoes.empty() && answer->echoes.front().seq == contact.cause.seq;
    });
    return came ? answer : std::nullopt;
  }

 private:
  template <class M>
  void keep(std::optional<M>& newest, const M& sample) {
    const std::lock_guard lock(mutex_);
    newest = sample;
  }
  template <class M>
  std::optional<M> get(const std::optional<M>& newest) {
    const std::lock_guard lock(mutex_);
    return newest;
  }

  int domain_;
  test::Process node_;
  std::mutex mutex_;
  std::optional<msg::OrganState> state_;
  std::optional<msg::SceneInfo> scene_;
  std::optional<msg::Topology> topology_;
  std::optional<msg::NodeStatus> status_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::Contact>> contacts_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> other_scenes_;
  std::unique_ptr<transport::Reader<msg::OrganState>> states_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scenes_;
  std::unique_ptr<transport::Reader<msg::Topology>> topologies_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
};

class DeformNodeTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  test::BlockScene block_{4};
  organ::Organ organ_ = block_.organ();
  Bench bench_{block_, GetParam().first, GetParam().second};
};

TEST_P(DeformNodeTest, ContactBecomesTheSurfaceThatThePlainSumGivesAndTheEndIsClean) {
  const msg::Contact contact = push(organ_, 7);
  std::optional<msg::OrganState> state;
  double difference = 0;
  // where a busy machine sends the contact too seldom, it fades
  const bool agrees = test::comes_true([&] {
    state = bench_.answer_to(contact);
    if (!state || state->values.size() != 3U * organ_.surface.node_count()) return true;
    difference = difference_from_plain_sum(organ_, contact, *state);
    return difference <= kWithin * largest(*state);
  });
  ASSERT_TRUE(state) << bench_.node().messages();
  EXPECT_EQ(state->block_count, 1U);
  ASSERT_EQ(state->values.size(), 3U * organ_.surface.node_count());
  EXPECT_TRUE(agrees) << difference << " m";
  EXPECT_GT(largest(*state), 1e-4);
  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_EQ(report["dds"], GetParam().first);
  EXPECT_GT(report["states"], 0);
  EXPECT_EQ(report["loop"]["rate_hz"], 100);
}

TEST_P(DeformNodeTest, LateJoinerLearnsTheSceneAndTheTopology) {
  ASSERT_TRUE(bench_.answer_to(push(organ_, 1)));
  ASSERT_TRUE(test::comes_true([&] { return bench_.scene() && bench_.topology() && bench_.status(); }));
  EXPECT_EQ(bench_.scene()->protocol, msg::PROTOCOL_VERSION);
  EXPECT_EQ(bench_.scene()->scene, "a block");
  ASSERT_EQ(bench_.scene()->organs.size(), 1U);
  EXPECT_EQ(bench_.scene()->organs[0].hash, organ_.hash);
  EXPECT_EQ(bench_.topology()->version, 0U);
  EXPECT_EQ(bench_.topology()->tetrahedron_count, organ_.mesh.tetrahedra.size());
  EXPECT_EQ(bench_.status()->kind, msg::NODE_DEFORM);
}

TEST_P(DeformNodeTest, StressIsMeasuredWhileAReaderIsThereAlone) {
  ASSERT_TRUE(bench_.answer_to(push(organ_, 1)));
  std::atomic<int> heard = 0;
  std::atomic<std::size_t> nodes = 0;
  for (int join = 0; join < 2; ++join) {
    const int before = heard;
    const auto reader = bench_.read_stress([&](const msg::OrganStress& stress) {
      nodes = stress.strains.size();
      ++heard;
    });
    EXPECT_TRUE(test::comes_true([&] { return heard - before >= 5; })) << "join " << join;
  }
  EXPECT_EQ(nodes, static_cast<std::size_t>(organ_.surface.node_count()));
  // a reader that left is noticed, and from then on nothing is measured
  const std::uint64_t seq = bench_.state()->seq;
  EXPECT_TRUE(test::comes_true([&] { return bench_.state()->seq > seq + 300; }));
  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_GE(report["stress_states"], heard.load());
  EXPECT_LT(report["stress_states"], report["states"].get<int>() - 200);
}

TEST_P(DeformNodeTest, ASceneWithAnotherOrganIsNotJoined) {
  bench_.send(block_.info("abc"));
  EXPECT_EQ(bench_.node().wait(), 2);
  EXPECT_NE(bench_.node().messages().find("abc"), std::string::npos) << bench_.node().messages();
  EXPECT_NE(bench_.node().messages().find(organ_.hash), std::string::npos) << bench_.node().messages();
}

INSTANTIATE_TEST_SUITE_P(Vendors, DeformNodeTest,
                         ::testing::Values(std::pair{"fast", transport::Vendor::kFast},
                                           std::pair{"cyclone", transport::Vendor::kCyclone},
                                           std::pair{"cyclone", transport::Vendor::kFast}),
                         [](const auto& test) {
                           return test.param.first +
                                  (test.param.second == transport::Vendor::kFast ? "ToFast" : "ToCyclone");
                         });

TEST(DeformNodeStart, BadInputIsOneLineAndExitCodeTwo) {
  test::expect_bad_starts_refused("deform_node");
}

}  // namespace
}  // namespace omentum
