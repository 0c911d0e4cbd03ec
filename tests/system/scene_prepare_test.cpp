// scene_prepare: a scene fits its organ, whichever organ that is.
#include "tests/support/meshes.h"
#include "tests/support/process.h"
#include "tests/system/prepared_skin.h"
#include "tests/system/session_on_trial.h"

#include <nlohmann/json.hpp>

namespace omentum::test {
namespace {

const std::string kOwnScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";
/// A slide may leave a curved surface by this part of its length: the hand's target is 10 mm below it.
constexpr double kLiftShare = 0.3;

class ForeignOrganTest : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(ForeignOrganTest, HandsPressOnTheSurfaceApartAndAwayFromTheSupportsAndSlideAlongIt) {
  const auto& [name, supports] = GetParam();
  const auto mesh = data_file("tet/" + name);
  if (!std::filesystem::exists(mesh)) GTEST_SKIP() << "the real meshes are absent";
  const ScratchFolder folder;
  const std::string organ = folder / "organ.h5", fitted = folder / "scene.toml";
  Process build("organ_build", {mesh, "-o", organ, "--young", "12000", "--poisson", "0.45", "--density",
                                "1060", "--scale", "0.001", "--fixed", supports});
  ASSERT_EQ(build.wait(), 0) << build.messages();
  Process prepare("scene_prepare", {kOwnScene, "--organ", organ, "-o", fitted});
  ASSERT_EQ(prepare.wait(), 0) << prepare.messages();

  const scene::Scene scene = scene::load_scene(fitted);
  EXPECT_EQ(scene.organs.front().file, organ);
  const Skin skin(organ);
  for (const scene::HandSpec& hand : scene.hands) {
    SCOPED_TRACE(hand.tool);
    expect_hand_fits(skin, hand);
    const Vec3 p = hand.press_point, d = hand.slide_direction;
    EXPECT_GT(skin.to_support(p), 0.1 * skin.diagonal());
    for (const double part : {0.5, 1.0})
      EXPECT_LE(skin.distance(p + part * hand.slide_m * d), kLiftShare * hand.slide_m + kOnSurface_m);
  }
  const Vec3 between = scene.hands[0].press_point - scene.hands[1].press_point;
  EXPECT_GT(between.norm(), 0.1 * skin.diagonal());
}

INSTANTIATE_TEST_SUITE_P(Meshes, ForeignOrganTest,
                         ::testing::Values(std::pair{"openhelp_liver_7k.msh", "plane:y>0.159"},
                                           std::pair{"sofaenv_gallbladder.vtk", "plane:y>0.0267"}),
                         [](const auto& test) {
                           return test.param.first.substr(0, test.param.first.find('.'));
                         });

// Rollers under every node and one pinned face; and an organ that leaves one place only for two hands.
// Neither may keep the search going for ever.
TEST(BoxTest, AwkwardSupportsStillGiveBothHandsAPlace) {
  const ScratchFolder folder;
  const std::filesystem::path mesh = folder / "box.msh";
  const std::string organ = folder / "organ.h5", fitted = folder / "scene.toml";
  geometry::write_mesh(make_box_mesh(4, 3, 3, {0.12, 0.09, 0.06}), mesh);
  for (const std::vector<std::string>& supports : {std::vector<std::string>{"plane:z>-1:z", "plane:x<0.01"},
                                                   {"plane:x<0.11", "plane:y<0.08", "plane:z<0.05"}}) {
    std::vector<std::string> arguments = {mesh,   "-o",        organ,  "--young", "12000", "--poisson",
                                          "0.45", "--density", "1060", "--scale", "1"};
    for (const std::string& support : supports) arguments.insert(arguments.end(), {"--fixed", support});
    Process build("organ_build", arguments);
    ASSERT_EQ(build.wait(), 0) << build.messages();
    Process prepare("scene_prepare", {kOwnScene, "--organ", organ, "-o", fitted});
    ASSERT_TRUE(comes_true([&] { return !prepare.running(); })) << supports.front();
    EXPECT_EQ(prepare.wait(), 0) << prepare.messages();
  }
}

TEST(BoxTest, AForeignOrganGivesTheSceneItsName) {
  const ScratchFolder folder;
  const std::filesystem::path mesh = folder / "box.msh";
  const std::string organ = folder / "kidney.h5", fitted = folder / "scene.toml";
  geometry::write_mesh(make_box_mesh(4, 3, 3, {0.12, 0.09, 0.06}), mesh);
  Process build("organ_build", {mesh, "-o", organ, "--young", "12000", "--poisson", "0.45", "--density",
                                "1060", "--scale", "1", "--fixed", "plane:z<0.01"});
  ASSERT_EQ(build.wait(), 0) << build.messages();
  Process prepare("scene_prepare", {kOwnScene, "--organ", organ, "-o", fitted});
  ASSERT_EQ(prepare.wait(), 0) << prepare.messages();
  const scene::Scene scene = scene::load_scene(fitted);
  EXPECT_EQ(scene.name, "kidney pressed by a simulated hand");
  EXPECT_EQ(scene.organs.front().name, "kidney");
  EXPECT_TRUE(scene.scenery.empty()) << "it lies around the scene's own organ";
}

// Whoever reads the fitted scene knows what the organ is made of, whichever organ it became.
TEST(BoxTest, AForeignOrgansMaterialsAreThoseOfTheFittedScene) {
  const ScratchFolder folder;
  const std::filesystem::path mesh = folder / "box.msh";
  const std::string organ = folder / "kidney.h5", fitted = folder / "scene.toml";
  geometry::write_mesh(make_box_mesh(4, 3, 3, {0.12, 0.09, 0.06}), mesh);
  Process build("organ_build",
                {mesh, "-o", organ, "--young", "9000", "--poisson", "0.4", "--density", "1000", "--scale",
                 "1", "--fixed", "plane:z<0.01", "--region", "ball=0.06,0.04,0.03,0.02;young=45000"});
  ASSERT_EQ(build.wait(), 0) << build.messages();
  Process prepare("scene_prepare", {kOwnScene, "--organ", organ, "-o", fitted});
  ASSERT_EQ(prepare.wait(), 0) << prepare.messages();
  const scene::Scene scene = scene::load_scene(fitted);
  const scene::OrganSpec& spec = scene.organs.front();
  EXPECT_EQ(spec.young_pa, 9000);
  EXPECT_EQ(spec.poisson, 0.4);
  EXPECT_EQ(spec.density_kg_m3, 1000);
  ASSERT_EQ(spec.regions.size(), 1u);
  EXPECT_EQ(spec.regions[0].label, 2) << "above the mesh's own";
  EXPECT_EQ(spec.regions[0].young_pa, 45000);
}

TEST(OwnOrganTest, SceneryHasTheFilesThatWereMadeOfIt) {
  const ScratchFolder folder;
  const std::string fitted = folder / "fitted.toml", made = folder / "cavity.msh";
  const scene::Scene held = scene::load_scene(held_scene());
  const auto prepare = [&](const std::vector<std::string>& files) {
    std::vector<std::string> words{kOwnScene, "--organ", held.organs.front().file,
                                   "-o",      fitted,    "--keep-points"};
    for (const std::string& file : files) words.insert(words.end(), {"--scenery", file});
    Process process("scene_prepare", words);
    const int code = process.wait();
    return std::pair(code, process.messages());
  };
  ASSERT_EQ(prepare({made}).first, 0);
  const std::vector<scene::ScenerySpec> scenery = scene::load_scene(fitted).scenery;
  ASSERT_EQ(scenery.size(), 3u);
  EXPECT_EQ(scenery[0].mesh, "phantom:cavity");
  EXPECT_EQ(scenery[0].file, made);
  EXPECT_TRUE(scenery[1].file.empty()) << "nobody made it";
  const auto [code, message] = prepare({made, made, made, made});
  EXPECT_EQ(code, 2);
  EXPECT_NE(message.find("--scenery: found 4 files, expected at most 3"), std::string::npos) << message;
}

TEST(OwnOrganTest, RegionsStayInTheFittedSceneAndAreToldAsOrganBuildTakesThem) {
  const ScratchFolder folder;
  const std::string scene = folder / "scene.toml", fitted = folder / "fitted.toml";
  std::string text = test::read_text(kOwnScene);
  text.insert(text.find("[[tools]]"),
              "[[organs.regions]]\nball = [-0.05, 0, 0.01, 0.01]\nyoung_pa = 30000\n"
              "[[organs.regions]]\nlabel = 4\npoisson = 0.3\n");
  std::ofstream(scene) << text;
  const scene::Scene held = scene::load_scene(held_scene());
  Process prepare("scene_prepare",
                  {scene, "--organ", held.organs.front().file, "-o", fitted, "--keep-points"});
  ASSERT_EQ(prepare.wait(), 0) << prepare.messages();
  const auto regions = scene::load_scene(fitted).organs.front().regions;
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions[0].ball, (std::vector<double>{-0.05, 0, 0.01, 0.01}));
  EXPECT_EQ(regions[0].young_pa, 30000);
  EXPECT_EQ(regions[1].label, 4);
  Process describe("scene_prepare", {fitted, "--describe"});
  EXPECT_EQ(describe.wait(), 0) << describe.messages();
  EXPECT_EQ(nlohmann::json::parse(describe.output())["organs"][0]["regions"],
            (nlohmann::json{"ball=-0.05,0.0,0.01,0.01; young=30000.0", "label=4; poisson=0.3"}));
}

/// Two boxes, one beside the other, and scenes/two_organs.toml, whose hands press one of its organs each.
class TwoOrgansTest : public ::testing::Test {
 protected:
  std::string box(const std::string& name, double at_x) {
    geometry::TetraMesh mesh = make_box_mesh(4, 3, 3, {0.12, 0.09, 0.06});
    for (Vec3& p : mesh.positions) p.x() += at_x;
    const std::string file = folder_ / (name + ".msh"), organ = folder_ / (name + ".h5");
    geometry::write_mesh(mesh, file);
    Process build("organ_build", {file, "-o", organ, "--young", "12000", "--poisson", "0.45", "--density",
                                  "1060", "--scale", "1", "--fixed", "plane:z<0.01"});
    EXPECT_EQ(build.wait(), 0) << build.messages();
    return organ;
  }
  scene::Scene prepared(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", fitted_});
    Process prepare("scene_prepare", arguments);
    EXPECT_EQ(prepare.wait(), 0) << prepare.messages();
    return scene::load_scene(fitted_);
  }

  const std::string scene_ = OMENTUM_SOURCE_DIR "/scenes/two_organs.toml";
  const ScratchFolder folder_;
  const std::string fitted_ = folder_ / "scene.toml";
};

TEST_F(TwoOrgansTest, EachHandIsProjectedOntoTheOrganThatItPresses) {
  const std::vector<std::string> files = {box("a", -0.2), box("b", 0.2)};
  const scene::Scene scene = prepared({scene_, "--keep-points", "--organ", files[0], "--organ", files[1]});
  ASSERT_EQ(scene.organs.size(), 2U);
  ASSERT_EQ(scene.hands.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.organs[i].file, files[i]);
    EXPECT_EQ(scene.hands[i].organ, scene.organs[i].name);
    EXPECT_LE(Skin(files[i]).distance(scene.hands[i].press_point), kOnSurface_m);
  }
  EXPECT_EQ(scene.organs[1].look, "gallbladder");
}

TEST_F(TwoOrgansTest, AForeignOrganTakesThePlaceOfTheFirstAndItsHandAndTheOtherHandStays) {
  const std::string foreign = box("kidney", -0.2), own = box("b", 0.2);
  const scene::Scene scene = prepared({scene_, "--organ", foreign, "--organ", own});
  EXPECT_EQ(scene.organs[0].name, "kidney");
  EXPECT_EQ(scene.organs[1].name, "gallbladder");
  EXPECT_EQ(scene.hands[0].organ, "kidney");
  EXPECT_EQ(scene.hands[1].organ, "gallbladder");
  expect_hand_fits(Skin(foreign), scene.hands[0]);
  EXPECT_LE(Skin(own).distance(scene.hands[1].press_point), kOnSurface_m);
  EXPECT_EQ(scene.hands[1].depth_m, scene::load_scene(scene_).hands[1].depth_m);
}

// An organ file as the scene's mesh has its tensors: another stiffness in the scene would change nothing.
TEST_F(TwoOrgansTest, ABuiltOrganIsOfTheMaterialThatItWasBuiltOf) {
  const std::string first = box("a", -0.2), second = box("b", 0.2), scene = folder_ / "built.toml";
  const std::string built =
      "name = \"x\"\nmesh = \"b.h5\"\nyoung_pa = 12000\npoisson = 0.45\n"
      "density_kg_m3 = 1060\n# end\n";
  const auto write = [&](const std::string& from, const std::string& to) {
    std::string text = read_text(scene_);
    const std::size_t begin = text.find("name = \"gallbladder\""), end = text.find("[[tools]]");
    std::string organ = built;
    organ.replace(organ.find(from), from.size(), to);
    text.replace(begin, end - begin, organ);
    text.replace(text.find("organ = \"gallbladder\""), 21, "organ = \"x\"");
    std::ofstream(scene) << text;
    const auto line =
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(to, begin)), '\n') + 1;
    return scene + ":" + std::to_string(line) + ": organs[1].";
  };
  write("12000", "12000");
  prepared({scene, "--keep-points", "--organ", first, "--organ", second});
  write("young_pa = 12000\npoisson = 0.45\ndensity_kg_m3 = 1060\n", "");
  const scene::Scene filled = prepared({scene, "--keep-points", "--organ", first, "--organ", second});
  EXPECT_EQ(filled.organs[1].young_pa, 12000) << "what the scene leaves out is the file's";
  EXPECT_EQ(filled.organs[1].density_kg_m3, 1060);
  std::filesystem::remove(fitted_);
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"young_pa = 12000", "young_pa = 6000", "young_pa: found 6000, expected 12000: the organ file is"},
           {"poisson = 0.45", "poisson = 0.3", "poisson: found 0.3, expected 0.45"},
           {"# end", "[[organs.regions]]\nlabel = 2\nyoung_pa = 1",
            "regions[0]: found another material, expected one of those that organ_check lists"}}) {
    const std::string place = write(from, to);
    Process prepare("scene_prepare",
                    {scene, "--keep-points", "--organ", first, "--organ", second, "-o", fitted_});
    EXPECT_EQ(prepare.wait(), 2);
    const std::string messages = prepare.messages();
    EXPECT_NE(messages.find(place + says), std::string::npos) << messages << place;
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_FALSE(std::filesystem::exists(fitted_));
  }
}

TEST_F(TwoOrgansTest, WrongFilesAreRefusedWithOneLineAndNothingIsWritten) {
  const std::string organ = box("kidney", 0), named = box("gallbladder", 0);
  for (const auto& [files, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{organ}, "two_organs.toml: organ \"gallbladder\" has no file, expected another --organ"},
           {{organ, organ, organ}, "--organ: found 3 files, expected at most 2"},
           {{named, organ}, "gallbladder.h5: found an organ called \"gallbladder\" as another one"}}) {
    std::vector<std::string> arguments = {scene_, "-o", fitted_};
    for (const std::string& file : files) arguments.insert(arguments.end(), {"--organ", file});
    Process prepare("scene_prepare", arguments);
    EXPECT_EQ(prepare.wait(), 2);
    const std::string messages = prepare.messages();
    EXPECT_NE(messages.find(says), std::string::npos) << messages;
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_FALSE(std::filesystem::exists(fitted_));
  }
}

TEST(OwnOrganTest, PressPointsAreProjectedOntoTheSurfaceAndNothingElseMoves) {
  const scene::Scene held = scene::load_scene(held_scene());
  const ScratchFolder folder;
  const std::string fitted = folder / "scene.toml";
  Process prepare("scene_prepare",
                  {kOwnScene, "--organ", held.organs.front().file, "-o", fitted, "--keep-points"});
  ASSERT_EQ(prepare.wait(), 0) << prepare.messages();
  const scene::Scene before = scene::load_scene(kOwnScene), after = scene::load_scene(fitted);
  const Skin skin(held.organs.front().file);
  EXPECT_EQ(after.name, before.name);
  ASSERT_EQ(after.hands.size(), before.hands.size());
  for (std::size_t i = 0; i < after.hands.size(); ++i) {
    expect_hand_fits(skin, after.hands[i]);
    const Vec3 wanted = before.hands[i].press_point;
    EXPECT_NEAR((after.hands[i].press_point - wanted).norm(), skin.distance(wanted), kOnSurface_m)
        << "the nearest surface point";
    EXPECT_EQ(after.hands[i].slide_m, before.hands[i].slide_m);
    EXPECT_EQ(after.hands[i].depth_m, before.hands[i].depth_m);
  }
  EXPECT_EQ(after.tools.front().trocar, before.tools.front().trocar);
  EXPECT_EQ(after.camera.eye, before.camera.eye);
  EXPECT_EQ(after.haptics.max_force_n, before.haptics.max_force_n);
}

}  // namespace
}  // namespace omentum::test
