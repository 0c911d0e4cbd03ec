#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

#include <cmath>

namespace omentum::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Scene, WhatIsNotWrittenKeepsItsDefault) {
  const auto file = write_scene(kGood);
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.organs[0].mesh, (file.parent_path() / "meshes/liver.msh").string());
  EXPECT_TRUE(scene.organs[0].file.empty());
  EXPECT_EQ(scene.organs[0].model, "quasi-static");
  EXPECT_EQ(scene.organs[0].kind, OrganKind::kTetrahedralMesh);
  EXPECT_EQ(scene.tools[0].id, 2u);
  ASSERT_EQ(scene.tools[0].points.size(), 2u);
  EXPECT_EQ(scene.tools[0].points[1], (Vec3{0, 0.001, 0}));
  EXPECT_FALSE(scene.tools[0].trocar);
  EXPECT_EQ(scene.hands[0].stiffness_n_m, HandSpec{}.stiffness_n_m);
  EXPECT_EQ(scene.hands[0].organ, "liver") << "the first organ";
  EXPECT_EQ(scene.haptics.contact, "point");
  EXPECT_EQ(scene.camera.mode, "orbit");
}

TEST(Scene, WhatIsWrittenIsRead) {
  const Scene scene = load_scene(write_scene(kGood + R"(depth_m = 0.02
start_s = 0
[haptics]
friction = 0.3
contact = "point"
max_force_n = 4
stale_s = 0.01
[camera]
mode = "endoscope"
eye = [1, 2, 3]
target = [4, 5, 6]
)"));
  EXPECT_EQ(scene.hands[0].depth_m, 0.02);
  EXPECT_EQ(scene.hands[0].start_s, 0);
  EXPECT_EQ(scene.haptics.friction, 0.3);
  EXPECT_EQ(scene.haptics.contact, "point");
  EXPECT_EQ(scene.haptics.max_force_n, 4);
  EXPECT_EQ(scene.haptics.stale_s, 0.01);
  EXPECT_EQ(scene.camera.mode, "endoscope");
  EXPECT_EQ(scene.camera.target, (Vec3{4, 5, 6}));
}

TEST(Scene, AnOrgansModelSaysItsKind) {
  for (const OrganModelWord& model : kOrganModels) {
    if (model.kind != OrganKind::kTetrahedralMesh) continue;  // intestine_keys_test.cpp
    const std::string part = model.word.starts_with("hybrid") ? "\ndynamic = \"plane:x>0\"" : "";
    const Scene scene = load_scene(write_scene(
        with("name = \"liver\"", "name = \"liver\"\nmodel = \"" + std::string(model.word) + "\"" + part)));
    EXPECT_EQ(scene.organs[0].model, model.word);
    EXPECT_EQ(scene.organs[0].kind, model.kind);
    EXPECT_EQ(scene.organs[0].dynamics.has_value(), model.feel == Feel::kLocalModels);
  }
}

TEST(Scene, ThePapersSpreadIsFrictionless) {
  const std::string spread = kGood + "[haptics]\ncontact = \"spread\"\n";
  EXPECT_EQ(load_scene(write_scene(spread)).haptics.contact, "spread");
  const auto file = write_scene(spread + "friction = 0.3\n");
  EXPECT_THAT(message_of(file),
              AllOf(HasSubstr(file.string() + ":20: haptics.friction: "), HasSubstr("contact = \"spread\"")));
}

// Each limit of force safety at a value that would switch it off, or make a blow of it.
TEST(Scene, NoSceneDisarmsForceSafety) {
  for (const std::string limit :
       {"max_force_n = 1000", "max_force_n = 0", "max_torque_nm = 100", "max_slew_n_s = 1e9", "ramp_s = 0",
        "ramp_s = 100", "stale_s = 1", "stale_s = inf", "decay_s = 10", "decay_s = 1e-9"}) {
    const auto file = write_scene(kGood + "[haptics]\n" + limit + "\n");
    const std::string key = limit.substr(0, limit.find(' '));
    EXPECT_THAT(message_of(file), HasSubstr(file.string() + ":19: haptics." + key + ": found ")) << limit;
  }
}

TEST(Scene, DirectionsAreNormalized) {
  const Scene scene = load_scene(write_scene(with("[0, 0, 1]\n", "[0.267, 0.535, 0.802]\n")));
  const Vec3 n = scene.hands[0].press_normal;
  EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-15);
}

TEST(Scene, AByteOrderMarkIsPassedOver) {
  EXPECT_EQ(load_scene(write_scene("\xEF\xBB\xBF" + kGood)).name, "test");
}

TEST(Scene, AMissingFileIsNamed) {
  EXPECT_THAT(message_of("/nonexistent/x.toml"),
              AllOf(HasSubstr("/nonexistent/x.toml"), HasSubstr("no such file")));
}

// toml++ quotes what it stumbled over as it is.
TEST(Scene, ARefusalIsOfOneLineWhateverTheFileHolds) {
  for (const std::string text : {"tru\n = 1", "level = t\n", "\"a\\nb\" = 1\n", "name = [\n1]\n"})
    EXPECT_THAT(message_of(write_scene(text)), Not(HasSubstr("\n"))) << text;
}

TEST(Scene, TheProjectsOwnScenesAreValid) {
  for (const auto& entry : std::filesystem::directory_iterator(OMENTUM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
  }
}

struct BadScene {
  const char* name;
  std::string line;  // of kGood
  std::string replacement;
  int line_number;  // that the message must name
  const char* says;
};

class BadSceneTest : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedNamingFileLineAndKey) {
  const BadScene& bad = GetParam();
  const auto file = write_scene(with(bad.line, bad.replacement));
  const std::string message = message_of(file);
  EXPECT_THAT(message, HasSubstr(file.string() + ":" + std::to_string(bad.line_number) + ": "));
  EXPECT_THAT(message, HasSubstr(bad.says));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadSceneTest,
    ::testing::Values(
        BadScene{"Syntax", "young_pa = 12000", "young_pa = ", 5, "expected value"},
        BadScene{"NegativeYoung", "12000", "-1", 5,
                 "organs[0].young_pa: found -1, expected a number above 0"},
        BadScene{"NotANumber", "12000", "nan", 5, "organs[0].young_pa: found nan"},
        BadScene{"TextForNumber", "12000", "\"soft\"", 5, "organs[0].young_pa: found 'soft'"},
        BadScene{"PoissonHalf", "0.45", "0.5", 6, "organs[0].poisson: found 0.5"},
        BadScene{"MissingDensity", "density_kg_m3 = 1060\n", "", 2, "organs[0].density_kg_m3: found nothing"},
        BadScene{"UnknownKey", "id = 2", "id = 2\npoint = 3", 11, "tools[0].point: found an unknown key"},
        BadScene{"UnknownTable", "[[tools]]", "[[tool]]", 9, "tool: found an unknown key"},
        BadScene{"UnknownPhantom", "meshes/liver.msh", "phantom:kidney", 4,
                 "organs[0].mesh: found \"phantom:kidney\""},
        BadScene{"UnknownModel", "name = \"liver\"", "name = \"liver\"\nmodel = \"jelly\"", 4,
                 "organs[0].model: found 'jelly', expected one of \"quasi-static\""},
        BadScene{"IdTooLarge", "id = 2", "id = 8", 10,
                 "tools[0].id: found 8, expected a whole number from 0 to 7"},
        BadScene{"IdNegative", "id = 2", "id = -1", 10, "tools[0].id: found -1"},
        BadScene{"UnknownShape", "\"probe\"\npoints", "\"spoon\"\npoints", 12,
                 "expected one of \"probe\", \"grasper\""},
        BadScene{"NoPoints", "[[0, 0, 0], [0, 0.001, 0]]", "[]", 13, "tools[0].points: found []"},
        BadScene{"ShortPoint", "[0, 0.001, 0]]", "[0, 0.001]]", 13, "tools[0].points[1]: found [ 0, 0.001 ]"},
        BadScene{"NotAUnitVector", "[0, 0, 1]\n", "[0, 0, 2]\n", 17, "of length 2, expected a unit vector"},
        BadScene{"HandWithoutTool", "tool = 2", "tool = 1", 15,
                 "hands[0].tool: found 1, expected the id of one"},
        BadScene{"HandOnNoOrgan", "tool = 2", "tool = 2\norgan = \"spleen\"", 16,
                 "hands[0].organ: found \"spleen\", expected the name of one of the [[organs]]"},
        BadScene{"UnknownLook", "young_pa = 12000", "young_pa = 12000\nlook = \"spleen\"", 6,
                 "expected one of \"liver\", \"gallbladder\", \"colon\""},
        BadScene{"SameIdTwice", "[[hands]]",
                 "[[tools]]\nid = 2\nname = \"x\"\nshape = \"probe\"\npoints = [[0, 0, 0]]\n[[hands]]", 15,
                 "tools[1].id: found 2 again"},
        BadScene{"SameHandTwice", "[[hands]]",
                 "[[hands]]\ntool = 2\npress_point = [0, 0, 0]\npress_normal = [0, 0, 1]\n[[hands]]", 19,
                 "hands[1].tool: found 2 again"},
        BadScene{"NegativeFriction", "[[hands]]", "[haptics]\nfriction = -0.1\n[[hands]]", 15,
                 "haptics.friction"},
        BadScene{"UnknownContact", "[[hands]]", "[haptics]\ncontact = \"glue\"\n[[hands]]", 15,
                 "haptics.contact: found 'glue', expected one of \"point\", \"spread\""},
        BadScene{"CameraWithoutEye", "[[hands]]", "[camera]\ntarget = [0, 0, 0]\n[[hands]]", 14,
                 "camera.eye: found nothing"}),
    [](const auto& info) { return info.param.name; });

// A second organ after the first one's last line, 8.
std::string with_second_organ(const std::string& name, const std::string& mesh) {
  return with("[[tools]]", "[[organs]]\nname = \"" + name + "\"\nmesh = \"" + mesh +
                               "\"\nyoung_pa = 4500\npoisson = 0.45\ndensity_kg_m3 = 1020\n" +
                               "fixed = \"plane:z>0\"\nlook = \"gallbladder\"\n[[tools]]");
}

// Nodes would refuse it when they start, without the line.
TEST(Scene, SupportsThatAreTooLongToTellAreRefusedWithTheirLine) {
  std::string boxes = "box:0,0,0,1,1,1";
  while (boxes.size() <= 142) boxes += "+box:0,0,0,1,1,1";
  const auto file = write_scene(with("fixed = ", "fixed = \"" + boxes + "\"\n#"));
  EXPECT_THAT(message_of(file),
              AllOf(HasSubstr(".toml:8: "), HasSubstr("fixed: found " + std::to_string(boxes.size()))));
}

TEST(Scene, AnOrganFileHasItsOwnMaterialSupportsAndMetres) {
  const std::string built = "meshes/liver.H5\"\n#";
  std::string text = with("meshes/liver.msh\"\nyoung_pa", built);
  for (const std::string key : {"poisson", "density_kg_m3", "fixed"}) text.replace(text.find(key), 0, "#");
  EXPECT_EQ(load_scene(write_scene(text)).organs[0].fixed, "");
  EXPECT_THAT(message_of(write_scene(with("meshes/liver.msh\"", built + "\nmetres_per_unit = 0.001"))),
              HasSubstr(".toml:6: organs[0].metres_per_unit: found one beside an organ file, expected none"));
  EXPECT_THAT(message_of(write_scene(with("liver.msh", "liver.h5"))),
              HasSubstr(".toml:8: organs[0].fixed: found one beside an organ file, expected none"));
}

TEST(Scene, APreparedOrganFileSaysItsMaterial) {
  std::string text = with("liver.msh\"\nyoung_pa", "liver.h5\"\nfile = \"liver.h5\"\n#");
  text.replace(text.find("fixed"), 0, "#");
  EXPECT_THAT(message_of(write_scene(text)), HasSubstr("organs[0].young_pa: found nothing"));
}

TEST(Scene, AHandMayNameTheOrganThatItPresses) {
  const Scene scene =
      load_scene(write_scene(with_second_organ("sac", "phantom:gallbladder") + "organ = \"sac\"\n"));
  ASSERT_EQ(scene.organs.size(), 2u);
  EXPECT_EQ(scene.organs[0].look, "liver");
  EXPECT_EQ(scene.organs[1].look, "gallbladder");
  EXPECT_EQ(scene.hands[0].organ, "sac");
}

TEST(Scene, OrgansOfOneNameAndUnknownPartsOfThePhantomAreRefusedWithTheirLine) {
  auto file = write_scene(with_second_organ("liver", "phantom:gallbladder"));
  EXPECT_THAT(message_of(file), HasSubstr(file.string() + ":10: organs[1].name: found \"liver\" again"));
  file = write_scene(with_second_organ("sac", "phantom:spleen"));
  EXPECT_THAT(message_of(file),
              AllOf(HasSubstr(file.string() + ":11: organs[1].mesh: found \"phantom:spleen\""),
                    HasSubstr("\"phantom:gallbladder\"")));
}

TEST(Scene, MoreThanEightToolsAreRefused) {
  std::string text = kGood;
  for (int i = 0; i < 8; ++i)
    text += "[[tools]]\nid = 0\nname = \"x\"\nshape = \"probe\"\npoints = [[0, 0, 0]]\n";
  EXPECT_THAT(message_of(write_scene(text)), HasSubstr("tools: found 9, expected 1 to 8 of [[tools]]"));
}

TEST(Scene, NoOrganIsRefused) {
  EXPECT_THAT(message_of(write_scene("name = \"empty\"\n")), HasSubstr("organs: found 0"));
}

}  // namespace
}  // namespace omentum::scene
