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

/// Whether tool 0 was answered to somebody who counts lower than who was answered before.
bool changes_hands(const std::vector<msg::ToolForce>& forces) {
  std::uint64_t newest = 0;
  for (const msg::ToolForce& force : forces) {
    if (force.tool != 0) continue;
    if (force.echo_seq < newest) return true;
    newest = force.echo_seq;
  }
  return false;
}

TEST(TakeoverTest, ASecondDeviceOnAToolIsRefusedUntilTheFirstIsGoneAndTheHandIsNotStruck) {
  constexpr std::uint64_t kApart = 100;  // of their counts: the second one began later
  SessionOnTrial session(held_scene(), all_on("fast"));
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  session.start_all({"haptic_node", "deform_node", "virtual_device"});
  ASSERT_TRUE(comes_true([&] {
    const auto force = observer.force();
    return force && force->echo_seq > 2 * kApart;
  })) << "the first one is not answered";
  Second other(session, "virtual_device", held_scene(), "cyclone");
  ASSERT_TRUE(comes_true([&] {
    const auto pose = observer.pose();
    const auto force = observer.force();
    return pose && force && pose->seq + kApart < force->echo_seq;
  })) << "the second one is not heard: "
      << other.process().messages();
  ASSERT_TRUE(comes_true([&] { return observer.force_n() > 0.1; })) << "the first one does not press";
  observer.forget();
  std::this_thread::sleep_for(milliseconds(500));  // ten times what a device that is alone needs to be taken
  const std::vector<msg::ToolForce> meanwhile = observer.forces();
  EXPECT_GT(meanwhile.size(), 100u);
  EXPECT_FALSE(changes_hands(meanwhile)) << "somebody else's pose was answered";
  EXPECT_GT(observer.force_n(), 0.1) << "the first hand lost what it feels";

  session.kill("virtual_device");
  EXPECT_TRUE(comes_true([&] { return changes_hands(observer.forces()); })) << "the second one is not taken";
  for (const std::uint32_t tool : {0U, 1U})
    EXPECT_LE(steepest(observer.forces(), tool), 1 + 1e-6) << "a hand was struck";
  EXPECT_EQ(session["haptic_node"].terminate(), 0);
  const std::string told = read_text(session.report_of("haptic_node"));
  EXPECT_NE(told.find("tool 0: pose refused"), std::string::npos) << told;
}

}  // namespace
}  // namespace omentum::test
