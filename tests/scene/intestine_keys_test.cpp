#include "scene/intestine_keys.h"
#include "scene/scene.h"
#include "scene/scene_values.h"
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A scene of one intestine with these lines beside its model; the first of them is the file's fifth.
std::filesystem::path intestine(const std::string& lines, const std::string& after = "") {
  return write_scene("name = \"test\"\n[[organs]]\nname = \"gut\"\nmodel = \"intestine\"\n" + lines + R"(
[[tools]]
id = 0
name = "probe"
shape = "probe"
points = [[0, 0, 0]]
)" + after);
}

TEST(IntestineKeys, NeedNoMeshAndKeepThePapersDefaults) {
  const OrganSpec organ = load_scene(intestine("")).organs[0];
  EXPECT_EQ(organ.kind, OrganKind::kTube);
  EXPECT_FALSE(organ.dynamics.has_value());
  ASSERT_TRUE(organ.intestine.has_value());
  EXPECT_EQ(organ.intestine->anatomy.length_m, 4);
  EXPECT_EQ(organ.intestine->anatomy.columns, 100);
  EXPECT_EQ(organ.intestine->collision, "complete");
  EXPECT_FALSE(organ.intestine->material.gut_stretch_n.has_value());
}

TEST(IntestineKeys, AreReadWithTheirPlace) {
  const auto file = intestine(
      "rows = 3\ncolumns = 50\norigin = [0.1, 0, 0.2]\nup = [0, 1, 0]\n"
      "mesentery_stretch_n_m = 500\nmethod = \"explicit\"\nstep_s = 0.0005\n"
      "collision = \"stochastic\"\nseed = 7\nfriction = 0.1");
  const IntestineSpec spec = *load_scene(file).organs[0].intestine;
  EXPECT_EQ(spec.anatomy.rows, 3);
  EXPECT_EQ(spec.anatomy.columns, 50);
  EXPECT_EQ(spec.anatomy.origin, Vec3(0.1, 0, 0.2));
  EXPECT_EQ(spec.anatomy.up, Vec3(0, 1, 0));
  EXPECT_EQ(spec.material.mesentery_stretch_n_m, 500);
  EXPECT_EQ(spec.method, "explicit");
  EXPECT_EQ(spec.step_s, 0.0005);
  EXPECT_EQ(spec.collision, "stochastic");
  EXPECT_EQ(spec.seed, 7u);
  EXPECT_EQ(spec.friction, 0.1);
  EXPECT_EQ(spec.where, file.string() + ":4");
}

TEST(IntestineKeys, WhatCannotBeIsRefusedWithItsLine) {
  const struct {
    const char *line, *expected;
  } wrong[] = {{"length_m = 0", "above 0"},
               {"tube_radius_m = -0.02", "above 0"},
               {"columns = 0", "at least 4"},
               {"rows = 1", "at least 2"},
               {"columns = 100000", "4000"},
               {"legs = 2", "at least 3"},
               {"up = [0, 0, 2]", "unit vector"},
               {"gut_mass_kg_m = 0", "above 0"},
               {"mesentery_mass_kg_m2 = 0.0", "above 0"},
               {"gut_stretch_n = -1", "above 0"},
               {"step_s = 0.5", "0.02"},
               {"method = \"verlet\"", "\"projective\""},
               {"collision = \"none\"", "\"complete\""},
               {"seed = -1", "0 to"},
               {"friction = -0.1", "0"},
               {"wall_stiffness_n_m = 0", "10"}};
  for (const auto& [line, expected] : wrong) {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    EXPECT_THAT(message_of(intestine(line)),
                AllOf(HasSubstr(":5: organs[0]." + key + ": found "), HasSubstr(expected)));
  }
}

TEST(IntestineKeys, AMeshHasNoneAndAnIntestineHasNoMesh) {
  EXPECT_THAT(message_of(write_scene(with("fixed = ", "length_m = 4\nfixed = "))),
              HasSubstr("organs[0].length_m: found an unknown key"));
  EXPECT_THAT(message_of(intestine("mesh = \"phantom:paper\"")),
              HasSubstr(":5: organs[0].mesh: found an unknown key"));
}

TEST(IntestineKeys, ObstaclesAreTheScenesAndEachIntestinesOwn) {
  const auto scene = load_scene(intestine("", R"([[obstacles]]
shape = "plane"
centre = [0, 0, -0.1]
normal = [0, 0, 1]
[[obstacles]]
shape = "ellipsoid"
centre = [0, 0, 0.1]
half_axes_m = [0.2, 0.15, 0.1]
)"));
  ASSERT_EQ(scene.obstacles.size(), 2u);
  EXPECT_EQ(scene.obstacles[0].centre, Vec3(0, 0, -0.1));
  EXPECT_EQ(scene.obstacles[1].half_axes_m, Vec3(0.2, 0.15, 0.1));
  EXPECT_EQ(scene.organs[0].intestine->obstacles.size(), 2u);
  const auto broken = [](const std::string& lines) {
    return message_of(intestine("", "[[obstacles]]\n" + lines));
  };
  EXPECT_THAT(broken("shape = \"cone\"\ncentre = [0, 0, 0]"), HasSubstr("obstacles[0].shape: found 'cone'"));
  EXPECT_THAT(broken("shape = \"plane\"\ncentre = [0, 0, 0]"),
              HasSubstr("obstacles[0].normal: found nothing"));
  EXPECT_THAT(broken("shape = \"box\"\ncentre = [0, 0, 0]\nhalf_axes_m = [1, 0, 1]"),
              HasSubstr("obstacles[0].half_axes_m: found "));
  EXPECT_THAT(broken("shape = \"box\"\ncentre = [0, 0, 0]\nhalf_axes_m = [1, 1, 1]\nnormal = [0, 0, 1]"),
              HasSubstr("obstacles[0].normal: found an unknown key"));
}

TEST(IntestineKeys, ObstaclesThatNothingMeetsAreRefused) {
  const std::string plane = "[[obstacles]]\nshape = \"plane\"\ncentre = [0, 0, 0]\nnormal = [0, 0, 1]\n";
  const auto file = write_scene(kGood + plane);
  EXPECT_THAT(message_of(file),
              AllOf(HasSubstr(":18: obstacles: found 1 in a scene without an intestine, expected none"),
                    HasSubstr("\"intestine\"")));
}

TEST(IntestineKeys, ThereAreNoMoreObstaclesThanAStepHasTimeFor) {
  std::string planes;
  for (std::size_t i = 0; i < kMostObstacles; ++i)
    planes += "[[obstacles]]\nshape = \"plane\"\ncentre = [0, 0, -1]\nnormal = [0, 0, 1]\n";
  EXPECT_EQ(load_scene(intestine("", planes)).obstacles.size(), kMostObstacles);
  EXPECT_THAT(message_of(intestine("", planes + planes)),
              HasSubstr("obstacles: found 32, expected at most 16 of [[obstacles]]"));
}

TEST(IntestineKeys, MachinesCompareThem) {
  const auto values = scene_values(load_scene(intestine("seed = 3\ngut_bending_n_m2 = 0.004", R"([[obstacles]]
shape = "plane"
centre = [0, 0, -0.1]
normal = [0, 0, 1]
)")));
  EXPECT_THAT(values, Contains("organs[0].length_m = 4"));
  EXPECT_THAT(values, Contains("organs[0].columns = 100"));
  EXPECT_THAT(values, Contains("organs[0].seed = 3"));
  EXPECT_THAT(values, Contains("organs[0].gut_bending_n_m2 = 0.004"));
  EXPECT_THAT(values, Contains("organs[0].gut_stretch_n = none"));
  EXPECT_THAT(values, Contains("obstacles[0].centre = [0, 0, -0.1]"));
  EXPECT_THAT(values, Not(Contains(HasSubstr("young_pa"))));
}

}  // namespace
}  // namespace omentum::scene
