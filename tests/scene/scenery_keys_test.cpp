// What a scene says of what is seen around its organs.
#include "scene/scenery_keys.h"
#include "scene/scene_values.h"
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::HasSubstr;

std::string surrounded_by(const std::string& keys) {
  return with("[[tools]]", "[[scenery]]\n" + keys + "[[tools]]");
}

TEST(SceneryKeys, APieceIsAWordOrAFileBesideTheScene) {
  const auto file =
      write_scene(surrounded_by("mesh = \"phantom:cavity\"\n[[scenery]]\nmesh = \"ribs.vtk\"\n"
                                "metres_per_unit = 0.001\nlook = \"omentum\"\n"));
  const std::vector<ScenerySpec> scenery = load_scene(file).scenery;
  ASSERT_EQ(scenery.size(), 2u);
  EXPECT_EQ(scenery[0].look, "wall");
  EXPECT_TRUE(scenery[0].file.empty()) << "nobody made it";
  EXPECT_EQ(scenery[1].file, file.parent_path() / "ribs.vtk");
  EXPECT_EQ(scenery[1].metres_per_unit, 0.001);
  EXPECT_EQ(scenery[1].look, "omentum");
}

TEST(SceneryKeys, APreparedSceneNamesTheFileOfAWord) {
  const auto file = write_scene(surrounded_by("mesh = \"phantom:omentum\"\nfile = \"made/omentum.msh\"\n"));
  EXPECT_EQ(load_scene(file).scenery.front().file, file.parent_path() / "made/omentum.msh");
}

TEST(SceneryKeys, MachinesMayHaveTheirOwn) {
  const Scene bare = load_scene(write_scene(kGood));
  const Scene surrounded = load_scene(write_scene(surrounded_by("mesh = \"phantom:cavity\"\n")));
  EXPECT_EQ(scene_values(surrounded), scene_values(bare));
}

TEST(SceneryKeys, WhatCannotBeIsRefusedWithItsPlace) {
  const auto refusal = [](const std::string& keys) { return message_of(write_scene(surrounded_by(keys))); };
  EXPECT_THAT(refusal("look = \"wall\"\n"), HasSubstr("scenery[0].mesh: found nothing"));
  EXPECT_THAT(refusal("mesh = \"phantom:heart\"\n"),
              HasSubstr("scenery[0].mesh: found \"phantom:heart\", expected \"phantom:cavity\""));
  EXPECT_THAT(refusal("mesh = \"a.msh\"\nlook = \"glass\"\n"), HasSubstr("scenery[0].look: found 'glass'"));
  EXPECT_THAT(refusal("mesh = \"a.msh\"\nmetres_per_unit = 0\n"), HasSubstr("scenery[0].metres_per_unit"));
  EXPECT_THAT(refusal("mesh = \"phantom:cavity\"\nmetres_per_unit = 2\n"),
              HasSubstr("the phantom is in metres"));
  EXPECT_THAT(refusal("mesh = \"a.msh\"\nmass_kg = 1\n"), HasSubstr("mass_kg: found an unknown key"));
  std::string many;
  for (std::size_t i = 0; i < kMostScenery; ++i) many += "mesh = \"a.msh\"\n[[scenery]]\n";
  EXPECT_THAT(refusal(many + "mesh = \"a.msh\"\n"), HasSubstr("expected at most 16"));
}

}  // namespace
}  // namespace omentum::scene
