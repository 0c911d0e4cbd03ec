// Somebody else is there already, or comes late: a second device on a tool, a second deform_node of a scene,
// a render_node that joins after the cuts.
#include "tests/system/cut_observer.h"
#include "tests/system/hurried_scene.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace omentum::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr const char* kFewPictures =
    "5";  // a second: two programs that draw have a processor each to do without

bool says(Process& process, const std::string& words) {
  return comes_true([&] { return process.messages().find(words) != std::string::npos; });
}

/// The plate's hook, which cuts sooner and as slowly: there is still something to cut when one node has died.
std::string plate_that_is_cut_soon(const std::filesystem::path& folder) {
  const std::string hold = "hold_s = 1.0";
  std::string scene = prepare_hurried("plate_cut", 1, folder);
  std::string text = read_text(scene);
  const std::size_t at = text.find(hold);
  EXPECT_NE(at, std::string::npos);
  std::ofstream(scene) << text.replace(std::min(at, text.size()), hold.size(),
                                       "hold_s = 0.1\napproach_s = 0.7");
  return scene;
}

/// One more of a program that a session has.
class Second {
 public:
  Second(const SessionOnTrial& session, const std::string& name, const std::string& scene,
         const std::string& vendor, std::vector<std::string> more = {})
      : process_(name, arguments(session, name, scene, vendor, std::move(more))) {}

  Process& process() { return process_; }
  json report() {
    EXPECT_EQ(process_.terminate(), 0) << process_.messages();
    return json::parse(read_text(folder_ / "report"));
  }

 private:
  std::vector<std::string> arguments(const SessionOnTrial& session, const std::string& name,
                                     const std::string& scene, const std::string& vendor,
                                     std::vector<std::string> more) const {
    more.insert(more.end(), {"--scene", scene, "--dds", vendor, "--domain", std::to_string(session.domain()),
                             "--report", (folder_ / "report").string()});
    if (name == "render_node") more.insert(more.end(), {"--headless", "--out", folder_.path().string()});
    return more;
  }

  ScratchFolder folder_;
  Process process_;
};

TEST(TakeoverTest, ADeformNodeThatStoodByGoesOnWithTheCutsAndALatePictureHasThemAll) {
  constexpr int kSome = 20;
  const ScratchFolder folder;
  const std::string scene = plate_that_is_cut_soon(folder.path()), journal = folder / "cuts.json";
  SessionOnTrial session(scene, all_on("fast"));
  CutObserver seen(session.domain());
  session.start("haptic_node");
  session.start("render_node", {"--fps", kFewPictures});
  session.start("deform_node", {"--journal", journal});
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  ASSERT_TRUE(comes_true([&] { return observer.state().has_value(); })) << "nobody serves";
  Second other(session, "deform_node", scene, "cyclone", {"--journal", journal});
  ASSERT_TRUE(says(other.process(), "this one stands by")) << other.process().messages();
  session.start("virtual_device");

  std::optional<msg::Topology> newest;
  const auto hear = [&] {
    for (msg::Topology& heard : seen.take()) {
      if (newest) {
        EXPECT_GE(heard.version, newest->version);
        EXPECT_TRUE(holds_all(heard, *newest)) << "what was cut is whole again";
      }
      newest = std::move(heard);
    }
    return newest ? removed(*newest) : 0;
  };
  ASSERT_TRUE(comes_true([&] { return hear() >= kSome; })) << session["virtual_device"].messages();
  session.kill("deform_node");
  ASSERT_TRUE(says(other.process(), "fell silent, this one serves")) << other.process().messages();
  const int at_the_death = hear();
  EXPECT_TRUE(comes_true([&] { return hear() > at_the_death; })) << "the new one does not cut on";
  EXPECT_LE(steepest(observer.forces(), 0), 1 + 1e-6) << "the hand was struck";

  // a picture that joins now is of the same organ as the one that saw every cut; paused, nobody cuts on
  ASSERT_EQ(session.command("pause"), 0);
  Second late(session, "render_node", scene, "cyclone", {"--fps", kFewPictures});
  observer.forget();
  ASSERT_TRUE(comes_true([&] {
    hear();
    std::set<std::uint64_t> drawing;  // whose newest status says that it shows this organ's states
    for (const msg::NodeStatus& status : observer.statuses(msg::NODE_RENDER))
      if (!status.echoes.empty()) drawing.insert(status.instance);
    return drawing.size() == 2;
  })) << late.process().messages();
  const int cut = hear();
  EXPECT_EQ(late.report()["removed_tetrahedra"], cut);
  EXPECT_EQ(session["render_node"].terminate(), 0);
  EXPECT_EQ(json::parse(read_text(session.report_of("render_node")))["removed_tetrahedra"], cut);
  EXPECT_TRUE(session["haptic_node"].running());
}

/// Whether the tool was answered to somebody who counts lower than who was answered before.
bool changes_hands(const std::vector<msg::ToolForce>& forces, std::uint32_t tool) {
  std::uint64_t newest = 0;
  for (const msg::ToolForce& force : forces) {
    if (force.tool != tool) continue;
    if (force.echo_seq < newest) return true;
    newest = force.echo_seq;
  }
  return false;
}

/// The held scene, whose first tool is for a recorded hand.
std::string scene_for_a_trace() {
  std::string text = read_text(held_scene());
  const std::string probe = "id = 0\n";
  const std::size_t at = text.find(probe);
  EXPECT_NE(at, std::string::npos);
  text.insert(std::min(at, text.size()), "device = \"trace\"\n");
  const auto scene = std::filesystem::path(held_scene()).parent_path() / "for_a_trace.toml";
  std::ofstream(scene) << text;
  return scene;
}

TEST(TakeoverTest, TheScenesDeviceTakesItsToolAndAnotherToolOnlyWhenItsHandIsGoneAndNobodyIsStruck) {
  const ScratchFolder folder;
  const std::string scene = scene_for_a_trace(), trace = folder / "rests_above.csv";
  std::ofstream(trace) << "t_s,px,py,pz,qw,qx,qy,qz,grip,tool\n0,-0.05,-0.02,0.07,1,0,0,0,0,0\n"
                          "0,0.03,0,0.07,1,0,0,0,0,1\n";
  SessionOnTrial session(scene, all_on("fast"));
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  session.start_all({"haptic_node", "virtual_device"});  // a hand needs no more
  ASSERT_TRUE(comes_true([&] { return observer.force_n() > 0.1; })) << "the first one does not press";

  Second wanted(session, "virtual_device", scene, "cyclone", {"--trace", trace});
  ASSERT_TRUE(comes_true([&] { return changes_hands(observer.forces(), 0); }))
      << "the scene's is not taken: " << wanted.process().messages();
  std::this_thread::sleep_for(milliseconds(300));  // six times what a device that is alone needs to be taken
  const std::vector<msg::ToolForce> meanwhile = observer.forces();
  EXPECT_FALSE(changes_hands(meanwhile, 1)) << "of two that nobody asked for the first one stays";
  observer.forget();
  std::this_thread::sleep_for(milliseconds(100));
  const std::vector<msg::ToolForce> later = observer.forces();
  EXPECT_FALSE(changes_hands(later, 0)) << "it went back";
  session.kill("virtual_device");
  EXPECT_TRUE(comes_true([&] { return changes_hands(observer.forces(), 1); }))
      << "the other tool is not taken";
  for (const std::uint32_t tool : {0U, 1U}) {
    EXPECT_LE(steepest(meanwhile, tool), 1 + 1e-6) << "a hand was struck";
    EXPECT_LE(steepest(observer.forces(), tool), 1 + 1e-6) << "a hand was struck";
  }
  EXPECT_EQ(session["haptic_node"].terminate(), 0);
  for (const char* tool : {"0", "1"})
    EXPECT_TRUE(
        says(session["haptic_node"], std::string("tool ") + tool + " goes from 'virtual hand' to 'trace'"))
        << session["haptic_node"].messages();
  const json told = json::parse(read_text(session.report_of("haptic_node")));
  for (const json& poses : told["poses"]) EXPECT_EQ(poses["hand_overs"]["count"], 1) << poses;
}

}  // namespace
}  // namespace omentum::test
