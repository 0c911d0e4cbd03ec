// The real render_node, as its neighbours see it: states in, pictures and status out.
#include "node_common/loaded_scene.h"
#include "render_node/png_file.h"

#include "block_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <mutex>
#include <optional>

namespace omentum {
namespace {

using geometry::Vec3;
using render::test::BlockScene;
using render::test::PressingTool;
using render::test::state_of;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> arguments(const BlockScene& scene, int domain, std::vector<std::string> more = {}) {
  std::vector<std::string> all{"--scene",
                               scene.scene(),
                               "--domain",
                               std::to_string(domain),
                               "--headless",
                               "--size",
                               "480x300",
                               "--out",
                               scene.file("pictures"),
                               "--report",
                               scene.file("report.json")};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

bool skipped_without_egl(test::Process& node) {
  return !node.running() && node.messages().find("off-screen pictures:") != std::string::npos;
}

TEST(RenderNode, BadInputEndsWithTwoAndOneLine) {
  const BlockScene scene(3);
  const auto refused = [&](std::vector<std::string> args) {
    test::Process node("render_node", args);
    EXPECT_EQ(node.wait(), 2);
    const std::string text = node.messages();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    return text;
  };
  EXPECT_THAT(refused({"--scene", "no/such.toml", "--headless"}), HasSubstr("no/such.toml"));
  EXPECT_THAT(refused({"--scene", scene.scene(), "--size", "10by10"}), HasSubstr("10by10"));
  EXPECT_THAT(refused({"--scene", scene.scene(), "--dds", "slow"}), HasSubstr("slow"));
  EXPECT_THAT(refused({"--scene", scene.scene(), "--headless", "--organ", "no/such.h5"}),
              HasSubstr("no/such.h5"));
}

TEST(RenderNode, ShowsStatesAndEchoesThePoseThatItDrew) {
  const BlockScene scene(3);
  const int domain = test::domain_of_test();
  test::Process node("render_node", arguments(scene, domain));
  const auto bus =
      transport::Bus::open({.vendor = transport::Vendor::kCyclone, .domain = domain, .name = "test"});
  const auto states = bus->writer<msg::OrganState>();
  std::mutex mutex;
  std::optional<msg::NodeStatus> heard;
  const auto statuses = bus->reader<msg::NodeStatus>([&](const msg::NodeStatus& status) {
    const std::lock_guard lock(mutex);
    heard = status;
  });
  std::uint64_t seq = 0;
  const bool echoed = test::comes_true([&] {
    ++seq;
    states->write(state_of(scene.organ(), seq, {0, 0, -0.01}));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::lock_guard lock(mutex);
    return skipped_without_egl(node) || (heard && !heard->echoes.empty());
  });
  if (skipped_without_egl(node)) GTEST_SKIP() << node.messages();
  ASSERT_TRUE(echoed) << node.messages();
  {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(heard->kind, msg::NODE_RENDER);
    EXPECT_GT(heard->echoes[0].seq, 100u);
    EXPECT_LE(heard->echoes[0].seq, 100 + seq);
    EXPECT_EQ(heard->echoes[0].stamp_ns, 5000);
  }
  PressingTool tool(*bus, scene.organ());
  EXPECT_TRUE(test::comes_true([&] {
    states->write(state_of(scene.organ(), ++seq, {0, 0, -0.01}));
    tool.speak();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return std::filesystem::exists(scene.file("pictures") / "indent.png");
  }));
  EXPECT_EQ(node.terminate(), 0) << node.messages();

  EXPECT_EQ(render::read_png(scene.file("pictures") / "final.png").size, (render::Size{480, 300}));
  EXPECT_TRUE(std::filesystem::exists(scene.file("pictures") / "frame_0001.png"));
  const auto report = nlohmann::json::parse(test::read_text(scene.file("report.json")));
  EXPECT_EQ(report["dds"], "fast");
  EXPECT_GT(report["frames"], 0);
  EXPECT_EQ(report["frame_us"]["count"], report["frames"]);
  EXPECT_NEAR(report["deepest_dent_m"], 0.01, 1e-6);
  EXPECT_EQ(report["closed"], false) << "SIGTERM is not a person who closes the window";
  EXPECT_TRUE(report["faults"].empty()) << report;
}

TEST(RenderNode, WhereNothingCanDrawItSaysWhyInOneLineAndThatNobodyDidWrong) {
  const BlockScene scene(3);
  std::ofstream(scene.file("libEGL.so.1")) << "no library";
  for (const auto& [name, value] : {std::pair("LD_LIBRARY_PATH", scene.file("").string()),
                                    std::pair("LIBGL_DRIVERS_PATH", scene.file("none").string())}) {
    setenv(name, value.c_str(), 1);
    test::Process node("render_node", arguments(scene, test::domain_of_test()));
    EXPECT_EQ(node.wait(), 3) << name;
    const std::string text = node.messages();
    EXPECT_THAT(text, HasSubstr("render_node: off-screen pictures: ")) << name;
    EXPECT_THAT(text, HasSubstr("installed?")) << name;
    unsetenv(name);
  }
}

TEST(RenderNode, EndsByItselfAfterItsTime) {
  const BlockScene scene(3);
  test::Process node("render_node",
                     arguments(scene, test::domain_of_test(), {"--seconds", "1", "--no-panel"}));
  const int code = node.wait();
  if (skipped_without_egl(node)) GTEST_SKIP() << node.messages();
  EXPECT_EQ(code, 0) << node.messages();
  EXPECT_TRUE(std::filesystem::exists(scene.file("pictures") / "final.png"));
}

TEST(RenderNode, RefusesToShowAnotherOrganThanTheOneServed) {
  const BlockScene scene(3);
  const int domain = test::domain_of_test();
  const auto bus =
      transport::Bus::open({.vendor = transport::Vendor::kFast, .domain = domain, .name = "test"});
  const auto scenes = bus->writer<msg::SceneInfo>();
  scenes->write(scene.info("0123abcd"));
  test::Process node("render_node", arguments(scene, domain));
  const int code = node.wait();
  if (skipped_without_egl(node)) GTEST_SKIP() << node.messages();
  EXPECT_EQ(code, 2);
  EXPECT_THAT(node.messages(), AllOf(HasSubstr("0123abcd"), HasSubstr(scene.organ().hash)));
}

TEST(RenderNode, RefusesToShowAnotherScene) {
  const BlockScene block(3);
  const int domain = test::domain_of_test();
  const auto bus =
      transport::Bus::open({.vendor = transport::Vendor::kFast, .domain = domain, .name = "test"});
  const auto scenes = bus->writer<msg::SceneInfo>();
  scene::Scene other = scene::load_scene(block.scene());
  other.organs[0].young_pa = 6000;
  scenes->write(node::to_message(node::loaded_scene(other, {{.name = "block", .hash = block.organ_hash()}}),
                                 "a block"));
  test::Process node("render_node", arguments(block, domain));
  const int code = node.wait();
  if (skipped_without_egl(node)) GTEST_SKIP() << node.messages();
  EXPECT_EQ(code, 2);
  EXPECT_THAT(node.messages(), HasSubstr("scene: organs[0].young_pa is 6000 at deform_node, 10000 here\n"));
}

TEST(RenderNode, SaysWhereThePicturesGoWhenThereIsNoDisplay) {
  const BlockScene scene(3);
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  test::Process node("render_node",
                     {"--scene", scene.scene(), "--domain", std::to_string(test::domain_of_test()),
                      "--seconds", "0.5", "--out", scene.file("pictures")});
  const int code = node.wait();
  if (skipped_without_egl(node)) GTEST_SKIP() << node.messages();
  EXPECT_EQ(code, 0) << node.messages();
  EXPECT_THAT(node.output(), AllOf(HasSubstr("no display"), HasSubstr(scene.file("pictures").string())));
}

}  // namespace
}  // namespace omentum
