#include "node_common/loaded_scene.h"

#include "scene/scene_values.h"
#include "transport/bounds.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace omentum::node {
namespace {

scene::Scene scene() {
  scene::Scene scene;
  scene.file = "a.toml";
  scene.name = "s";
  scene.organs.resize(2);
  scene.organs[0].name = "liver";
  scene.organs[0].young_pa = 12000;
  scene.organs[1].name = "spleen";
  scene.tools.resize(1);
  scene.tools[0].points.assign(2, scene::Vec3::Zero());
  return scene;
}

LoadedScene load(const scene::Scene& scene) {
  return loaded_scene(scene, {{.name = "liver", .hash = "aaaa"}, {.name = "spleen", .hash = "cccc"}});
}

class LoadedSceneTest : public testing::Test {
 protected:
  /// What a deform_node with `theirs` tells a node with scene().
  std::string refusal_of(const scene::Scene& theirs) const {
    return contradicts(loaded_, to_message(load(theirs), "s")).value_or("agrees");
  }
  const LoadedScene loaded_ = load(scene());
  msg::SceneInfo announced_ = to_message(loaded_, "s");
};

TEST_F(LoadedSceneTest, AnOrganOfAnotherKindIsNamed) {
  announced_.organs[0].kind = msg::KIND_TUBE;
  EXPECT_EQ(contradicts(loaded_, announced_),
            "organ liver: deform_node takes it for an organ of another kind");
}

TEST_F(LoadedSceneTest, AgreesWithItsOwn) {
  EXPECT_FALSE(contradicts(loaded_, announced_));
  LoadedScene first_of_two = loaded_;
  first_of_two.organs.pop_back();
  EXPECT_FALSE(contradicts(first_of_two, announced_)) << "a node may load the first organ only";
}

TEST_F(LoadedSceneTest, TheFirstValueThatDiffersIsNamed) {
  scene::Scene softer = scene();
  softer.organs[0].young_pa = 6000;
  softer.haptics.friction = 0.5;
  EXPECT_EQ(refusal_of(softer), "scene: organs[0].young_pa is 6000 at deform_node, 12000 here");
}

TEST_F(LoadedSceneTest, AValueThatOneSideHasNotIsNamed) {
  scene::Scene longer = scene(), shorter = scene();
  longer.tools[0].points.push_back({1, 2, 3});
  EXPECT_EQ(refusal_of(longer), "scene: tools[0].points[2] is [1, 2, 3] at deform_node, not given here");
  shorter.tools[0].points.pop_back();
  EXPECT_EQ(refusal_of(shorter), "scene: tools[0].points[1] is not given at deform_node, [0, 0, 0] here");
  shorter = scene();
  shorter.organs.pop_back();
  EXPECT_EQ(refusal_of(shorter), "scene: organs[1].name is not given at deform_node, spleen here");
}

// Whoever writes scene_info: a line that says something, and no crash.
TEST_F(LoadedSceneTest, NonsenseIsRefusedInOneLine) {
  announced_.hash = "0";
  std::vector<std::vector<std::string>> nonsense = {
      {},           loaded_.values,    {loaded_.values.rbegin(), loaded_.values.rend()},
      {"", "", ""}, {" = ", "organs"}, {"organs[0].name = a\nb"}};
  for (const auto& values : nonsense) {
    announced_.values = values;
    const auto why = contradicts(loaded_, announced_);
    ASSERT_TRUE(why);
    EXPECT_TRUE(why->starts_with("scene: ")) << *why;
    EXPECT_EQ(why->find('\n'), std::string::npos) << *why;
  }
}

TEST_F(LoadedSceneTest, AnotherOrganFileIsRefusedWithBothHashes) {
  announced_.organs[0].hash = "bbbb";
  const auto why = contradicts(loaded_, announced_);
  ASSERT_TRUE(why);
  for (const char* part : {"aaaa", "bbbb", "liver"}) EXPECT_NE(why->find(part), std::string::npos) << *why;
}

TEST_F(LoadedSceneTest, WhatAStrangerWritesIsToldInOneLine) {
  msg::SceneInfo more = announced_;
  more.scene = "a\nb";
  more.organs.push_back({.name = "spleen", .hash = "cccc"});
  announced_.organs[0].hash = "b\x1b[2J\n";
  for (const msg::SceneInfo& info : {more, announced_}) {
    const auto why = contradicts(loaded_, info);
    ASSERT_TRUE(why);
    EXPECT_EQ(why->find_first_of("\n\x1b"), std::string::npos) << *why;
  }
}

TEST_F(LoadedSceneTest, ValuesInAnotherOrderAreAnotherVersions) {
  announced_.hash = "0";
  announced_.values = {loaded_.values.rbegin(), loaded_.values.rend()};
  EXPECT_EQ(contradicts(loaded_, announced_),
            "scene: deform_node is another version of Omentum, whose scene values are listed otherwise");
}

TEST_F(LoadedSceneTest, AnotherProtocolAndAnotherNumberOfOrgansAreRefused) {
  msg::SceneInfo newer = announced_;
  ++newer.protocol;
  ASSERT_TRUE(contradicts(loaded_, newer));
  EXPECT_NE(contradicts(loaded_, newer)->find("protocol"), std::string::npos);
  msg::SceneInfo more = announced_;
  more.organs.push_back({.name = "spleen", .hash = "cccc"});
  EXPECT_TRUE(contradicts(loaded_, more));
  announced_.organs.clear();
  EXPECT_TRUE(contradicts(loaded_, announced_));
}

TEST_F(LoadedSceneTest, WhatIsToldFitsItsMessage) {
  LoadedScene loaded = loaded_;
  loaded.organs[0].name = std::string(100, 'x');
  EXPECT_TRUE(transport::within_bounds(to_message(loaded, std::string(100, 'y'))));
}

std::string message_of(const scene::Scene& scene) {
  try {
    require_tellable(scene);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(RequireTellable, ValuesThatSceneInfoCannotCarryAreNamed) {
  scene::Scene wordy = scene();
  const std::size_t most = msg::MAX_LINE - std::string("tools[0].name = ").size();
  wordy.tools[0].name.assign(most, 'x');
  EXPECT_EQ(message_of(wordy), "accepted");
  wordy.tools[0].name += 'x';
  EXPECT_EQ(message_of(wordy), "a.toml: tools[0].name: found " + std::to_string(most + 1) +
                                   " characters, expected at most " + std::to_string(most));
  scene::Scene large = scene();
  large.tools[0].points.assign(msg::MAX_SCENE_LINES, scene::Vec3::Zero());
  const std::string expected = " values, expected at most " + std::to_string(msg::MAX_SCENE_LINES);
  EXPECT_NE(message_of(large).find(expected), std::string::npos) << message_of(large);
}

}  // namespace
}  // namespace omentum::node
