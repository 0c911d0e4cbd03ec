// The real deform_node, as its neighbours see it: Contact in, OrganState out, over either vendor.
#include "organ/organ.h"
#include "transport/bus.h"

#include "tests/nodes/deform_block.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <mutex>
#include <optional>

namespace omentum {
namespace {

using deform_test::BlockScene;
using geometry::SurfaceId;
using geometry::Vec3;

/// OrganState holds floats, and so do the tensors.
constexpr double kWithin = 1e-3;

/// deform_node, and what it publishes.
class Bench {
 public:
  Bench(const BlockScene& scene, const std::string& node_vendor, transport::Vendor own)
      : domain_(test::domain_of_test()),
        node_("deform_node", {"--scene", scene.scene(), "--dds", node_vendor, "--domain",
                              std::to_string(domain_), "--report", scene.report()}),
        bus_(transport::Bus::open({.vendor = own, .domain = domain_, .name = "test"})),
        contacts_(bus_->writer<msg::Contact>()),
        commands_(bus_->writer<msg::SessionCommand>()),
        other_scenes_(bus_->writer<msg::SceneInfo>()),
        others_(bus_->writer<msg::NodeStatus>()),
        states_(bus_->reader<msg::OrganState>([this](const msg::OrganState& s) { keep(state_, s); })),
        scenes_(bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& s) { keep(scene_, s); })),
        topologies_(bus_->reader<msg::Topology>([this](const msg::Topology& t) { keep(topology_, t); })),
        statuses_(bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& s) {
          if (s.kind == msg::NODE_DEFORM) keep(status_, s);
        })) {}

  std::optional<msg::OrganState> state() { return get(state_); }
  /// The next one that comes.
  std::optional<msg::OrganState> next_state() {
    const auto before = state();
    std::optional<msg::OrganState> next;
    test::comes_true([&] {
      next = state();
      return next && (!before || next->seq != before->seq);
    });
    return next;
  }
  std::optional<msg::SceneInfo> scene() { return get(scene_); }
  std::optional<msg::Topology> topology() { return get(topology_); }
  std::optional<msg::NodeStatus> status() { return get(status_); }
  test::Process& node() { return node_; }

  void send(const msg::Contact& contact) { contacts_->write(contact); }
  void send(const msg::SceneInfo& scene) { other_scenes_->write(scene); }
  void send(const msg::NodeStatus& status) { others_->write(status); }
  void command(std::uint32_t command) {
    commands_->write({.order = ++commands_sent_, .sender = 1, .command = command, .argument = {}});
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
  std::uint64_t commands_sent_ = 0;
  std::mutex mutex_;
  std::optional<msg::OrganState> state_;
  std::optional<msg::SceneInfo> scene_;
  std::optional<msg::Topology> topology_;
  std::optional<msg::NodeStatus> status_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::Contact>> contacts_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> other_scenes_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> others_;
  std::unique_ptr<transport::Reader<msg::OrganState>> states_;
  std::unique_ptr<transport::Reader<msg::SceneInfo>> scenes_;
  std::unique_ptr<transport::Reader<msg::Topology>> topologies_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
};

/// Pushes four mobile surface nodes, by mesh file number.
msg::Contact push(const organ::Organ& organ, std::uint64_t seq) {
  msg::Contact contact{};
  contact.cause = {.tool = 0, .seq = seq, .stamp_ns = 5};
  for (int i = 0; i < 4; ++i) {
    const SurfaceId s(i * (organ.surface.mobile_count / 4));
    contact.nodes.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[organ.surface.node[s]]));
    contact.forces.push_back({0.1 * i, -0.2, -1.0 + 0.1 * i});
  }
  contact.displacements.resize(contact.nodes.size());
  return contact;
}

double largest(const msg::OrganState& state) {
  double value = 0;
  for (const float u : state.values) value = std::max(value, std::abs(static_cast<double>(u)));
  return value;
}

/// Largest difference from u = C f, node by node, with the organ file's own tensors.
double difference_from_plain_sum(const organ::Organ& organ, const msg::Contact& contact,
                                 const msg::OrganState& state) {
  const auto of_file_node = organ.surface_of_file_node();
  double worst = 0;
  for (std::int32_t n = 0; n < organ.surface.node_count(); ++n) {
    Vec3 plain = Vec3::Zero();
    for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
      const msg::Vec3& f = contact.forces[i];
      plain += organ.compliance->block(SurfaceId(n), of_file_node[contact.nodes[i]]) * Vec3(f.x, f.y, f.z);
    }
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(plain[c] - state.values[3 * n + c]));
  }
  return worst;
}

class DeformNodeTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  BlockScene block_;
  organ::Organ organ_ = block_.organ();
  Bench bench_{block_, GetParam().first, GetParam().second};
};

TEST_P(DeformNodeTest, ContactBecomesTheSurfaceThatThePlainSumGives) {
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

TEST_P(DeformNodeTest, ResetAndSilenceBringTheOrganBackToRest) {
  ASSERT_TRUE(bench_.answer_to(push(organ_, 1)));
  EXPECT_TRUE(test::comes_true([&] { return largest(*bench_.state()) == 0; })) << "the sender fell silent";
  ASSERT_TRUE(bench_.answer_to(push(organ_, 2)));
  bench_.command(msg::COMMAND_RESET);
  EXPECT_TRUE(test::comes_true([&] { return largest(*bench_.state()) == 0; }));
}

TEST_P(DeformNodeTest, PausedItKeepsItsShapeAndGoesOnPublishing) {
  ASSERT_TRUE(bench_.answer_to(push(organ_, 1)));
  ASSERT_TRUE(test::comes_true([&] {
    bench_.send(push(organ_, 1));
    bench_.command(msg::COMMAND_PAUSE);
    return bench_.status() && bench_.status()->paused;
  }));
  const auto held = bench_.next_state();
  ASSERT_TRUE(held);
  const std::uint64_t enough = held->seq + 60;  // longer than a silent sender's contact lasts
  ASSERT_TRUE(test::comes_true([&] { return bench_.state()->seq > enough; }));
  EXPECT_EQ(bench_.state()->values, held->values);
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(test::comes_true([&] { return largest(*bench_.state()) == 0; }));
}

TEST_P(DeformNodeTest, WhoJoinsAPausedSessionIsPaused) {
  msg::NodeStatus device{};
  device.kind = msg::NODE_DEVICE;
  device.instance = 1;
  device.paused = true;
  bench_.send(device);
  ASSERT_TRUE(test::comes_true([&] { return bench_.status() && bench_.status()->paused; }));
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(test::comes_true([&] { return !bench_.status()->paused; }));
  EXPECT_EQ(bench_.status()->newest_order, 1u) << "for those who have just come";
}

TEST_P(DeformNodeTest, ASceneWithAnotherOrganIsNotJoined) {
  bench_.send(block_.info("abc"));
  EXPECT_EQ(bench_.node().wait(), 2);
  EXPECT_NE(bench_.node().messages().find("abc"), std::string::npos) << bench_.node().messages();
  EXPECT_NE(bench_.node().messages().find(organ_.hash), std::string::npos) << bench_.node().messages();
}

TEST_P(DeformNodeTest, BadContactsAreFaultsInItsReportAndTheEndIsClean) {
  msg::Contact bad = push(organ_, 9);
  bad.topology_version = 5;
  ASSERT_TRUE(test::comes_true([&] {
    bench_.send(bad);
    return bench_.status() && !bench_.status()->faults.empty();
  }));
  const auto state = bench_.next_state();
  ASSERT_TRUE(state) << bench_.node().messages();
  EXPECT_EQ(largest(*state), 0);
  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_EQ(report["dds"], GetParam().first);
  EXPECT_GT(report["states"], 0);
  EXPECT_GT(report["steps"], 0);
  EXPECT_EQ(report["removed_tetrahedra"], 0);
  EXPECT_GT(report["loop"]["ticks"], 0);
  EXPECT_EQ(report["loop"]["rate_hz"], 100);
  ASSERT_EQ(report["faults"].size(), 1U);
}

TEST_P(DeformNodeTest, ContactsThatNoToolOfTheSceneMakesMoveNothing) {
  msg::Contact strong = push(organ_, 1), foreign = push(organ_, 2);
  strong.forces[0].z = -1e30;
  foreign.tool = foreign.cause.tool = 5;
  ASSERT_TRUE(test::comes_true([&] {
    bench_.send(strong);
    bench_.send(foreign);
    return bench_.status() && bench_.status()->faults.size() >= 2;
  }));
  const auto state = bench_.next_state();
  ASSERT_TRUE(state) << bench_.node().messages();
  EXPECT_EQ(largest(*state), 0);
  EXPECT_TRUE(state->echoes.empty());
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
  const test::ScratchFolder folder;
  std::ofstream(folder / "broken.toml") << "name = \n";
  std::ofstream(folder / "no_file.toml")
      << "name = \"n\"\n[[organs]]\nname = \"o\"\nmesh = \"m.msh\"\nyoung_pa = 1\n"
         "poisson = 0.3\ndensity_kg_m3 = 1\nfixed = \"plane:z<0\"\n"
         "[[tools]]\nid = 0\nname = \"p\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
  std::ofstream(folder / "broken.h5") << "not an organ";
  const std::string good = folder / "no_file.toml";
  const std::vector<std::vector<std::string>> table = {
      {"--scene", folder / "missing.toml"},
      {"--scene", folder / "broken.toml"},
      {"--scene", good},
      {"--scene", good, "--organ", folder / "missing.h5"},
      {"--scene", good, "--organ", folder / "broken.h5"},
      {"--scene", good, "--dds", "telepathy"},
      {"--scene", good, "--domain", "231"},
      {"--scene", good, "--rate-hz", "-1"},
      {},
  };
  for (const auto& arguments : table) {
    test::Process node("deform_node", arguments);
    EXPECT_EQ(node.wait(), 2) << (arguments.empty() ? "no arguments" : arguments.back());
    const std::string messages = node.messages();
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_TRUE(messages.starts_with("deform_node: ")) << messages;
  }
}

}  // namespace
}  // namespace omentum
