// What a scene says of an endoscope, and of who holds it.
#include "scene/scene_values.h"
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kScopeTool = "[[tools]]\nid = 3\nname = \"the eye\"\nshape = \"endoscope\"\n";

/// The good scene with these lines before its tool, and these in a table before its organs.
std::string seen_through(const std::string& tool, const std::string& score = {}) {
  std::string text = with("[[tools]]", tool + "[[tools]]");
  return score.empty() ? text : text.replace(text.find("[[organs]]"), 0, score + "\n");
}

TEST(ScopeKeys, AnEndoscopeHasOpticsAndNoPoints) {
  const ToolSpec tool = load_scene(write_scene(seen_through(kScopeTool))).tools[0];
  ASSERT_TRUE(tool.scope);
  EXPECT_EQ(tool.scope->optics_deg, 30);
  EXPECT_TRUE(tool.points.empty());
  const Scene scene =
      load_scene(write_scene(seen_through(kScopeTool + "optics_deg = 45\nfield_of_view_deg = 70\n")));
  EXPECT_EQ(scene.tools[0].scope->optics_deg, 45);
  EXPECT_EQ(scene.tools[0].scope->field_of_view_deg, 70);
  EXPECT_FALSE(scene.tools[1].scope);
  EXPECT_THAT(scene_values(scene), Contains("tools[0].optics_deg = 45"));
  EXPECT_THAT(scene_values(scene), Not(Contains(HasSubstr("tools[1].optics_deg"))));
}

TEST(ScopeKeys, WhatAnEndoscopeCannotHaveIsRefused) {
  const auto refusal = [](const std::string& keys) { return message_of(write_scene(seen_through(keys))); };
  EXPECT_THAT(refusal(kScopeTool + "points = [[0, 0, 0]]\n"),
              HasSubstr("tools[0].points: found one of an endoscope, expected none: it touches nothing"));
  EXPECT_THAT(refusal(kScopeTool + "cuts = true\n"), HasSubstr("tools[0].cuts: found one of an endoscope"));
  EXPECT_THAT(refusal(kScopeTool + "optics_deg = 90\n"), HasSubstr("tools[0].optics_deg: found 90"));
  EXPECT_THAT(refusal(kScopeTool + "grip_force_n = 5\n"), HasSubstr("grip_force_n: found an unknown key"));
  EXPECT_THAT(
      refusal(kScopeTool + kScopeTool.substr(0, 10) + "id = 4\nname = \"b\"\nshape = \"endoscope\"\n"),
      HasSubstr("tools[1].shape: found a second endoscope"));
  EXPECT_THAT(message_of(write_scene(with("points", "optics_deg = 30\npoints"))),
              HasSubstr("optics_deg: found an unknown key"))
      << "a probe has none";
}

TEST(ScopeKeys, TheCameraIsScoredByAToolOrByAPlace) {
  const auto scored = [](const std::string& keys) {
    return write_scene(seen_through(kScopeTool, "[score.camera]\n" + keys));
  };
  const auto by_tool = load_scene(scored("tool = 2\nwithin_deg = 8")).score.camera;
  ASSERT_TRUE(by_tool);
  EXPECT_EQ(by_tool->tool, 2u);
  EXPECT_EQ(by_tool->within_deg, 8);
  const auto by_place = load_scene(scored("organ = \"liver\"\nplace = [0, 0.1, 0.2]")).score.camera;
  EXPECT_FALSE(by_place->tool);
  EXPECT_EQ(by_place->organ, "liver");
  EXPECT_EQ(by_place->place, Vec3(0, 0.1, 0.2));
  EXPECT_THAT(message_of(scored("within_deg = 8")), HasSubstr("score.camera.tool: found no target"));
  EXPECT_THAT(message_of(scored("tool = 2\norgan = \"liver\"")), HasSubstr("found a tool and an organ"));
  EXPECT_THAT(message_of(scored("tool = 3")), HasSubstr("score.camera.tool: found 3, expected the id of one"))
      << "a scope does not look at itself";
  EXPECT_THAT(message_of(scored("organ = \"colon\"\nplace = [0, 0, 0]")), HasSubstr("found \"colon\""));
  EXPECT_THAT(message_of(scored("organ = \"liver\"")), HasSubstr("score.camera.place: found nothing"));
  EXPECT_THAT(message_of(scored("tool = 2\nwithin_deg = 60")), HasSubstr("score.camera.within_deg"));
  EXPECT_THAT(message_of(write_scene(with("[[organs]]", "[score.camera]\ntool = 2\n[[organs]]"))),
              HasSubstr("score.camera: found one without a scope"));
}

TEST(ScopeKeys, WaypointsRollAToolAboutItsShaft) {
  const std::string way = "[[hands.way]]\nto = [0, 0, 0.1]\nseconds = 1\nroll_rad = -0.4\n";
  const Scene scene = load_scene(write_scene(kGood.substr(0, kGood.find("press_point")) + way));
  EXPECT_EQ(scene.hands[0].way[0].roll_rad, -0.4);
  EXPECT_THAT(scene_values(scene), Contains("hands[0].way[0].roll_rad = -0.4"));
}

}  // namespace
}  // namespace omentum::scene
