// What is cut stays cut, whoever dies.
#include "tests/system/cut_observer.h"
#include "tests/system/hurried_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::test {
namespace {

/// A scene, and the vendor of each process.
struct CutTrial {
  std::string name, scene;
  Vendors vendors;
  double hurry = 1;  // how many times as fast as the scene says hands go along their waypoints

  friend void PrintTo(const CutTrial& trial, std::ostream* out) { *out << trial.name; }
};

/// Each made once.
const std::string& prepared(const CutTrial& trial) {
  static std::map<std::string, std::unique_ptr<ScratchFolder>> folders;
  static std::map<std::string, std::string> scenes;
  if (!scenes.contains(trial.scene)) {
    const auto& folder = folders[trial.scene] = std::make_unique<ScratchFolder>();
    scenes[trial.scene] = prepare_hurried(trial.scene, trial.hurry, folder->path());
  }
  return scenes[trial.scene];
}

class CutSurvivalTest : public ::testing::TestWithParam<CutTrial> {
 protected:
  /// Of a deform_node that knows what the last one cut.
  void start_organ() { session_.start("deform_node", {"--journal", journal_}); }
  /// Waits for the hook to have cut a good part of its way.
  std::optional<msg::Topology> half_cut() {
    constexpr int kSome = 40;
    std::optional<msg::Topology> newest;
    comes_true([&] {
      for (msg::Topology& heard : seen_.take()) newest = std::move(heard);
      return newest && removed(*newest) >= kSome;
    });
    return newest;
  }

  ScratchFolder folder_;
  std::string journal_ = folder_ / "cuts.json";
  SessionOnTrial session_{prepared(GetParam()), GetParam().vendors};
  Observer observer_{session_.domain(), transport::Vendor::kCyclone};
  CutObserver seen_{session_.domain()};
};

TEST_P(CutSurvivalTest, ADeformNodeThatIsKilledWhileItCutsGoesOnWithItsCuts) {
  session_.start("haptic_node");
  start_organ();
  session_.start("virtual_device");
  auto before = half_cut();
  ASSERT_TRUE(before) << session_["deform_node"].messages() << session_["virtual_device"].messages();
  session_.kill("deform_node");
  for (msg::Topology& heard : seen_.take()) before = std::move(heard);
  start_organ();
  std::vector<msg::Topology> after;
  ASSERT_TRUE(comes_true([&] { return !(after = seen_.take()).empty(); }))
      << session_["deform_node"].messages();
  EXPECT_GE(after.front().version, before->version);
  EXPECT_TRUE(holds_all(after.front(), *before));
  EXPECT_TRUE(comes_true([&] {
    const auto state = observer_.state();
    return state && state->topology_version >= after.front().version;
  }));
  EXPECT_TRUE(session_["haptic_node"].running());
  const std::vector<msg::ToolForce> felt = observer_.forces();
  EXPECT_GT(felt.size(), 500u);
  for (const std::uint32_t tool : {0U, 1U})
    EXPECT_LE(steepest(felt, tool), 1 + 1e-6) << "the hand was struck that has tool " << tool;
  observer_.forget();
  EXPECT_TRUE(comes_true([&] { return observer_.forces().size() > 500; })) << "haptic_node fell silent";
  EXPECT_EQ(session_["deform_node"].messages(), "");
}

TEST_P(CutSurvivalTest, AHandsNodeAPictureOrADeviceThatIsKilledWhileItCutsLeavesTheCutAsItIs) {
  session_.start("render_node");
  session_.start("haptic_node");
  start_organ();
  session_.start("virtual_device");
  const auto before = half_cut();
  ASSERT_TRUE(before) << session_["virtual_device"].messages();
  for (const std::string name : {"haptic_node", "render_node", "virtual_device"}) {
    session_.kill(name);
    if (name == "haptic_node") observer_.forget();
    session_.start(name);
  }
  EXPECT_TRUE(comes_true([&] { return observer_.forces().size() > 500; })) << "the new node does not answer";
  const std::vector<msg::ToolForce> felt = observer_.forces();  // of the new node alone, from its first on
  for (const std::uint32_t tool : {0U, 1U})
    EXPECT_LE(steepest(felt, tool), 1 + 1e-6) << "the hand was struck that has tool " << tool;
  observer_.forget();
  EXPECT_TRUE(comes_true([&] {
    const auto status = observer_.status(msg::NODE_RENDER);
    return status && !status->echoes.empty();
  })) << "no state was drawn: "
      << session_["render_node"].messages();
  ASSERT_EQ(session_["render_node"].terminate(), 0) << session_["render_node"].messages();
  int newest = removed(*before);
  for (const msg::Topology& heard : seen_.take()) {
    EXPECT_GE(heard.version, before->version);
    EXPECT_TRUE(holds_all(heard, *before));
    newest = removed(heard);
  }
  const auto picture = nlohmann::json::parse(read_text(session_.report_of("render_node")));
  EXPECT_GE(picture["removed_tetrahedra"], removed(*before)) << "the new picture is of another organ";
  EXPECT_LE(picture["removed_tetrahedra"], newest);
  EXPECT_TRUE(session_["deform_node"].running());
  for (const std::string name : {"haptic_node", "virtual_device"})
    EXPECT_TRUE(session_[name].running()) << session_[name].messages();
}

// Two hands at a hybrid organ, one of which holds what the other one cuts.
const Vendors kMixed{{"haptic_node", "fast"},
                     {"deform_node", "cyclone"},
                     {"render_node", "cyclone"},
                     {"virtual_device", "fast"}};

INSTANTIATE_TEST_SUITE_P(Sessions, CutSurvivalTest,
                         ::testing::Values(CutTrial{"fast", "plate_cut", all_on("fast")},
                                           CutTrial{"cyclone", "plate_cut", all_on("cyclone")},
                                           CutTrial{"hepatectomy", "hepatectomy", kMixed, 2.5}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace omentum::test
