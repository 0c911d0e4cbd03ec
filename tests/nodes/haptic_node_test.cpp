// The real haptic_node, as a device and its neighbours see it: poses in, forces and contacts out, over either
// vendor.
#include "organ/organ.h"
#include "runtime/clock.h"
#include "transport/bus.h"

#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <mutex>
#include <optional>

namespace omentum {
namespace {

using geometry::Vec3;

// Forces leave as doubles; contacts' forces are summed again here.
constexpr double kRelative = 1e-9;
// From when on a node is not moved by newcomers (haptic_node/serving_claim.h), and a second more.
constexpr double kSettled_s = 6;

/// A block of 10 cm, held at z = 0, one probe and one grasper.
class BlockScene {
 public:
  BlockScene() {
    geometry::write_mesh(test::make_box_mesh(6, 6, 6, Vec3::Constant(0.1)), folder_ / "block.msh");
    test::Process build("organ_build",
                        {folder_ / "block.msh", "-o", folder_ / "block.h5", "--young", "10000", "--poisson",
                         "0.4", "--density", "1000", "--scale", "1", "--fixed", "plane:z<0.001"});
    if (build.wait() != 0) throw std::runtime_error(build.messages());
    std::ofstream(folder_ / "scene.toml")
        << "name = \"a block\"\n"
           "[[organs]]\nname = \"block\"\nmesh = \"block.msh\"\nfile = \"block.h5\"\n"
           "young_pa = 10000\npoisson = 0.4\ndensity_kg_m3 = 1000\nfixed = \"plane:z<0.001\"\n"
           "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0], [0.003,0,0.001]]\n"
           "[[tools]]\nid = 3\nname = \"grasper\"\nshape = \"grasper\"\npoints = [[0,0,0]]\n";
  }
  std::string scene() const { return folder_ / "scene.toml"; }
  std::string report() const { return folder_ / "report.json"; }
  std::string organ_hash() const {
    return organ::load_organ(folder_ / "block.h5", organ::Load::kMeshOnly).hash;
  }

 private:
  test::ScratchFolder folder_;
};

Vec3 vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

/// haptic_node, and a device of this test's own.
class Bench {
 public:
  Bench(const BlockScene& scene, const std::string& node_vendor, transport::Vendor own)
      : scene_(scene),
        vendor_(node_vendor),
        domain_(test::domain_of_test()),
        node_("haptic_node", arguments(scene.report())),
        bus_(transport::Bus::open({.vendor = own, .domain = domain_, .name = "test"})),
        poses_(bus_->writer<msg::ToolPose>()),
        devices_(bus_->writer<msg::DeviceInfo>()),
        commands_(bus_->writer<msg::SessionCommand>()),
        scenes_(bus_->writer<msg::SceneInfo>()),
        others_(bus_->writer<msg::NodeStatus>()),
        forces_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce& f) { take(f); })),
        contacts_(bus_->reader<msg::Contact>([this](const msg::Contact& c) { take(c); })),
        statuses_(bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& s) { take(s); })) {}

  std::vector<std::string> arguments(const std::string& report) const {
    return {"--scene",  scene_.scene(),          "--dds",    vendor_,
            "--domain", std::to_string(domain_), "--report", report};
  }

  /// Sends the pose of tool 0 for as long as `wait` is false, at about 1 kHz. False when patience ends.
  template <class Condition>
  bool hold(const Vec3& tip, Condition&& wait) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!wait()) {
      if (std::chrono::steady_clock::now() > end) return false;
      send(tip);
    }
    return true;
  }
  /// Down or up in steps of 0.2 mm.
  void move(const Vec3& from, const Vec3& to) {
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 2e-4));
    for (int i = 1; i <= steps; ++i) send(from + (to - from) * i / steps);
  }
  void send(const Vec3& tip) {
    msg::ToolPose pose{};
    pose.seq = ++seq_;
    pose.stamp_ns = runtime::steady_now_ns();
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    poses_->write(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void send(const msg::ToolPose& pose) { poses_->write(pose); }
  void send(const msg::DeviceInfo& info) { devices_->write(info); }
  void send(const msg::SceneInfo& info) { scenes_->write(info); }
  void send(const msg::NodeStatus& status) { others_->write(status); }
  void command(std::uint32_t command) {
    commands_->write({.seq = ++commands_sent_, .command = command, .argument = {}});
  }

  /// The forces of a press have faded in and stay: the last answer and the contact of the same tick or later.
  bool press() {
    const bool engaged = hold(kAbove, [&] { return force() && force()->state == 0; });
    move(kAbove, kPressed);
    return engaged && hold(kPressed, [&] { return force()->state == 0 && newton() > 0.1; });
  }

  std::optional<msg::ToolForce> force() const { return get(force_); }
  std::optional<msg::Contact> contact() const { return get(contact_); }
  std::optional<msg::NodeStatus> status() const { return get(status_); }
  double newton() const { return force() ? vector(force()->force).norm() : 0; }
  std::uint64_t seq() const { return seq_; }
  test::Process& node() { return node_; }
  int domain() const { return domain_; }

  static const Vec3 kAbove, kPressed;

 private:
  void take(const msg::ToolForce& force) {
    const std::lock_guard lock(mutex_);
    if (force.tool == 0) force_ = force;
  }
  void take(const msg::Contact& contact) {
    const std::lock_guard lock(mutex_);
    if (contact.tool == 0) contact_ = contact;
  }
  void take(const msg::NodeStatus& status) {
    const std::lock_guard lock(mutex_);
    if (status.kind == msg::NODE_HAPTIC) status_ = status;
  }
  template <class M>
  std::optional<M> get(const std::optional<M>& newest) const {
    const std::lock_guard lock(mutex_);
    return newest;
  }

  const BlockScene& scene_;
  std::string vendor_;
  int domain_;
  test::Process node_;
  mutable std::mutex mutex_;
  std::optional<msg::ToolForce> force_;
  std::optional<msg::Contact> contact_;
  std::optional<msg::NodeStatus> status_;
  std::uint64_t seq_ = 0, commands_sent_ = 0;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> poses_;
  std::unique_ptr<transport::Writer<msg::DeviceInfo>> devices_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> scenes_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> others_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Reader<msg::Contact>> contacts_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
};

const Vec3 Bench::kAbove(0.048, 0.053, 0.103), Bench::kPressed(0.048, 0.053, 0.094);

class HapticNodeTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  BlockScene block_;
  Bench bench_{block_, GetParam().first, GetParam().second};
};

// The hand feels its share of what the tissue bears (haptic_node/contact_energy.h): the same way, and near to
// one where it was pressed straight down.
TEST_P(HapticNodeTest, PressedTissueAnswersAndItsContactSumsUpToTheForce) {
  constexpr double kShare = 0.25, kSide = 0.1;
  ASSERT_TRUE(bench_.press()) << bench_.node().messages();
  // a contact and a force of the same tick
  ASSERT_TRUE(bench_.hold(Bench::kPressed, [&] {
    const auto force = bench_.force();
    const auto contact = bench_.contact();
    if (!contact || contact->tick != force->tick || contact->nodes.empty()) return false;
    Vec3 sum = Vec3::Zero();
    for (const msg::Vec3& f : contact->forces) sum += vector(f);
    const Vec3 felt = vector(force->force);
    EXPECT_NEAR(felt.norm(), sum.norm(), kShare * sum.norm());
    EXPECT_LE((felt / felt.norm() + sum / sum.norm()).norm(), kSide);
    EXPECT_EQ(contact->cause.seq, force->echo_seq);
    EXPECT_EQ(contact->displacements.size(), contact->nodes.size());
    return true;
  }));
  EXPECT_GT(vector(bench_.force()->force).z(), 0);
  EXPECT_LE(bench_.force()->echo_seq, bench_.seq());
}

TEST_P(HapticNodeTest, ASilentDeviceIsToldZeroAndTheTissueIsLetGo) {
  ASSERT_TRUE(bench_.press());
  EXPECT_TRUE(
      test::comes_true([&] { return bench_.newton() == 0 && (bench_.force()->state & msg::FORCE_STALE); }));
  EXPECT_TRUE(test::comes_true([&] { return bench_.contact()->nodes.empty(); }));
}

TEST_P(HapticNodeTest, RubbishOnTheTopicIsAFaultAndNoForce) {
  ASSERT_TRUE(bench_.press());
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  pose.position.x = std::nan("");
  for (int i = 0; i < 300; ++i) {
    pose.seq = bench_.seq() + 1;
    bench_.send(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(std::isfinite(bench_.newton()));
  }
  EXPECT_TRUE(test::comes_true([&] { return bench_.newton() == 0; }));
  EXPECT_TRUE(test::comes_true([&] { return !bench_.status()->faults.empty(); }));
  EXPECT_NE(bench_.status()->faults[0].find("not finite"), std::string::npos);
}

TEST_P(HapticNodeTest, PauseIsZeroAndStartFadesIn) {
  ASSERT_TRUE(bench_.press());
  bench_.command(msg::COMMAND_PAUSE);
  EXPECT_TRUE(bench_.hold(Bench::kPressed, [&] {
    return bench_.newton() == 0 && (bench_.force()->state & msg::FORCE_PAUSED) && bench_.status()->paused;
  }));
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(bench_.hold(Bench::kPressed, [&] { return (bench_.force()->state & msg::FORCE_RAMP) != 0; }));
  EXPECT_TRUE(
      bench_.hold(Bench::kPressed, [&] { return bench_.force()->state == 0 && bench_.newton() > 0.1; }));
}

TEST_P(HapticNodeTest, ResetLetsGoOfTheTissue) {
  ASSERT_TRUE(bench_.press());
  bench_.command(msg::COMMAND_RESET);
  EXPECT_TRUE(
      bench_.hold(Bench::kAbove, [&] { return bench_.contact()->nodes.empty() && bench_.newton() == 0; }));
}

TEST_P(HapticNodeTest, TheDevicesLimitHolds) {
  msg::DeviceInfo info{};
  info.name = "a weak device";
  info.max_force_n = 0.05;
  info.max_torque_nm = 1;
  info.max_stiffness_n_m = 1000;
  bench_.send(info);
  ASSERT_TRUE(bench_.hold(Bench::kAbove, [&] { return bench_.force() && bench_.force()->state == 0; }));
  bench_.move(Bench::kAbove, Bench::kPressed);
  EXPECT_TRUE(
      bench_.hold(Bench::kPressed, [&] { return (bench_.force()->state & msg::FORCE_CLAMPED) != 0; }));
  EXPECT_LE(bench_.newton(), 0.05 * (1 + kRelative));
}

TEST_P(HapticNodeTest, AnotherNodeForItsToolsYields) {
  ASSERT_TRUE(test::comes_true([&] { return bench_.status().has_value(); }));
  test::Process second("haptic_node", bench_.arguments("/dev/null"));
  EXPECT_EQ(second.wait(), 2);
  EXPECT_NE(second.messages().find("already served"), std::string::npos) << second.messages();
  EXPECT_TRUE(bench_.node().running());
}

// A device tells that the session is paused; the node that starts, or starts again, finds it so.
TEST_P(HapticNodeTest, WhoJoinsAPausedSessionIsPaused) {
  msg::NodeStatus device{};
  device.kind = msg::NODE_DEVICE;
  device.instance = 1;
  device.paused = true;
  bench_.send(device);
  ASSERT_TRUE(bench_.hold(Bench::kAbove, [&] { return bench_.status() && bench_.status()->paused; }));
  EXPECT_TRUE(bench_.hold(Bench::kAbove, [&] {
    return bench_.force() && (bench_.force()->state & msg::FORCE_PAUSED) && bench_.newton() == 0;
  }));
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(bench_.hold(Bench::kAbove, [&] { return !bench_.status()->paused; }));
}

const msg::SceneInfo kStrangersScene{
    .protocol = msg::PROTOCOL_VERSION, .scene = "s", .organs = {{.name = "o", .hash = "abc"}}};

TEST_P(HapticNodeTest, AnotherOrganFileIsRefusedWithBothHashes) {
  bench_.send(kStrangersScene);
  EXPECT_EQ(bench_.node().wait(), 2);
  EXPECT_NE(bench_.node().messages().find("abc"), std::string::npos) << bench_.node().messages();
  EXPECT_NE(bench_.node().messages().find(block_.organ_hash()), std::string::npos);
}

TEST_P(HapticNodeTest, AStrangersSceneDoesNotEndAPress) {
  ASSERT_TRUE(bench_.press());
  ASSERT_TRUE(bench_.hold(Bench::kPressed, [&] {
    return bench_.status() &&
           static_cast<double>(bench_.status()->ticks) > kSettled_s * bench_.status()->rate_hz;
  }));
  bench_.send(kStrangersScene);
  EXPECT_TRUE(bench_.hold(Bench::kPressed, [&] { return !bench_.status()->faults.empty(); }));
  EXPECT_NE(bench_.status()->faults[0].find("another organ"), std::string::npos);
  EXPECT_TRUE(bench_.node().running());
  EXPECT_TRUE(bench_.hold(Bench::kPressed, [&] { return bench_.newton() > 0.1; }));
}

TEST_P(HapticNodeTest, EndsCleanlyWithItsReport) {
  bench_.send(msg::SceneInfo{.protocol = msg::PROTOCOL_VERSION,
                             .scene = "s",
                             .organs = {{.name = "o", .hash = block_.organ_hash()}}});
  ASSERT_TRUE(bench_.press());
  const double pressed = bench_.newton();
  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_EQ(report["dds"], GetParam().first);
  EXPECT_EQ(report["loop"]["rate_hz"], 1000);
  EXPECT_GT(report["loop"]["ticks"], 0);
  EXPECT_GT(report["contacts"]["ticks_in_contact"], 0);
  EXPECT_GT(report["contacts"]["nodes_max"], 0);
  EXPECT_GE(report["force_n"]["max"], 0.9 * pressed);
  EXPECT_GT(report["force_n"]["mean"], 0);
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
}

INSTANTIATE_TEST_SUITE_P(Vendors, HapticNodeTest,
                         ::testing::Values(std::pair{"fast", transport::Vendor::kFast},
                                           std::pair{"cyclone", transport::Vendor::kCyclone},
                                           std::pair{"fast", transport::Vendor::kCyclone}),
                         [](const auto& test) {
                           return test.param.first +
                                  (test.param.second == transport::Vendor::kFast ? "ToFast" : "ToCyclone");
                         });

// What no node obeys must not look as if it had been done.
TEST(SessionProgram, RecordIsRefusedUntilItExists) {
  test::Process command("omentum_session", {"record"});
  EXPECT_EQ(command.wait(), 2);
  EXPECT_TRUE(command.messages().starts_with("omentum_session: ")) << command.messages();
  EXPECT_NE(command.messages().find("record"), std::string::npos) << command.messages();
}

TEST(HapticNodeStart, BadInputIsOneLineAndExitCodeTwo) {
  const test::ScratchFolder folder;
  const std::string organ =
      "name = \"n\"\n[[organs]]\nname = \"o\"\nmesh = \"m.msh\"\nyoung_pa = 1\n"
      "poisson = 0.3\ndensity_kg_m3 = 1\nfixed = \"plane:z<0\"\n";
  std::ofstream(folder / "broken.toml") << "name = \n";
  std::ofstream(folder / "no_file.toml")
      << organ << "[[tools]]\nid = 0\nname = \"p\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
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
    test::Process node("haptic_node", arguments);
    EXPECT_EQ(node.wait(), 2) << (arguments.empty() ? "no arguments" : arguments.back());
    const std::string messages = node.messages();
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_TRUE(messages.starts_with("haptic_node: ")) << messages;
  }
}

}  // namespace
}  // namespace omentum
