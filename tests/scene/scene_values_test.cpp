#include "scene/scene_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace omentum::scene {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Scene small_scene() {
  Scene scene;
  scene.name = "small";
  scene.organs.resize(1);
  scene.organs[0].name = "liver";
  scene.organs[0].young_pa = 6000;
  scene.organs[0].poisson = 0.45;
  scene.organs[0].fixed = "plane:z<-0.02";
  scene.tools.resize(2);
  scene.tools[1].points = {{0, 0, 0}, {0.1, 1e-9, -2.5}};
  scene.hands.resize(1);
  return scene;
}

TEST(SceneValues, AreOnePerLineUnderTheNamesOfTheFile) {
  const auto values = scene_values(small_scene());
  EXPECT_THAT(values, Contains("organs[0].young_pa = 6000"));
  EXPECT_THAT(values, Contains("organs[0].poisson = 0.45"));
  EXPECT_THAT(values, Contains("organs[0].fixed = plane:z<-0.02"));
  EXPECT_THAT(values, Contains("tools[1].points[1] = [0.1, 1e-09, -2.5]"));
  EXPECT_THAT(values, Contains("tools[0].trocar = none"));
  EXPECT_THAT(values, Contains("haptics.contact = point"));
  for (const std::string& value : values) EXPECT_EQ(std::count(value.begin(), value.end(), '\n'), 0) << value;
}

// What is computed with, by the last bit.
TEST(SceneValues, EveryDifferenceThatIsFeltOrScoredChangesTheHash) {
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.organs[0].young_pa = std::nextafter(s.organs[0].young_pa, 1e9); },
      [](Scene& s) { s.organs[0].name += " "; },
      [](Scene& s) { s.organs.resize(2); },
      [](Scene& s) { s.tools[1].points[0][2] = std::numeric_limits<double>::denorm_min(); },
      [](Scene& s) { s.tools[1].points.pop_back(); },
      [](Scene& s) { s.tools[0].trocar = Vec3{}; },
      [](Scene& s) { std::swap(s.tools[0], s.tools[1]); },
      [](Scene& s) { s.hands[0].press_s += 1; },
      [](Scene& s) { s.hands[0].cut = true; },
      [](Scene& s) {
        s.tools[0].edge = {{0, 0, 0}, {0, 0, 0.01}};
      },
      [](Scene& s) { s.haptics.max_force_n = 4; },
      [](Scene& s) { s.score.exposed_organ = "liver"; },
      [](Scene& s) {
        s.score.planned_line = {{0, 0, 0}, {0, 0, 0.01}};
      },
      [](Scene& s) { s.score.pull_limit_n = 1; },
      [](Scene& s) { s.score.camera.emplace(); },
  };
  const std::string hash = scene_hash(scene_values(small_scene()));
  EXPECT_EQ(hash.size(), 64u);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene other = small_scene();
    changes[i](other);
    EXPECT_NE(scene_hash(scene_values(other)), hash) << "change " << i;
  }
}

TEST(SceneValues, PathsNameAndCameraAreAMachinesOwn) {
  Scene here = small_scene(), there = small_scene();
  here.organs[0].fixed = "/home/a/fixed.csv";
  there.organs[0].fixed = "/srv/fixed.csv";
  there.organs[0].mesh = "/srv/liver.msh";
  there.organs[0].file = "/srv/liver.h5";
  there.name = "another name";
  there.file = "/srv/scene.toml";
  there.camera.eye = {1, 2, 3};
  EXPECT_EQ(scene_values(here), scene_values(there));
  EXPECT_THAT(scene_values(here), Not(Contains(HasSubstr("/"))));
}

TEST(SceneValues, NoTextBreaksALine) {
  Scene scene = small_scene();
  scene.tools[0].name = std::string("a\nb\0c\x7f", 6) + "\xc3\xa9";
  EXPECT_THAT(scene_values(scene), Contains("tools[0].name = a\\x0ab\\x00c\\x7f\xc3\xa9"));
}

}  // namespace
}  // namespace omentum::scene
