// What a scene says of an organ's regions and of a tool's edge.
#include "tests/scene/written_scene.h"

#include <gmock/gmock.h>

namespace omentum::scene {
namespace {

using ::testing::HasSubstr;

TEST(SceneParts, RegionsAreReadWithThePlaceAndWhatDiffers) {
  const Scene scene = load_scene(write_scene(with("[[tools]]", R"([[organs.regions]]
label = -3
young_pa = 30000
[[organs.regions]]
box = [0, 0, 0, 1, 2, 3]
poisson = 0.3
[[organs.regions]]
ball = [0.01, 0, 0.02, 0.005]
density_kg_m3 = 1200
[[tools]])")));
  const std::vector<RegionSpec>& regions = scene.organs[0].regions;
  ASSERT_EQ(regions.size(), 3u);
  EXPECT_EQ(regions[0].label, -3);
  EXPECT_EQ(regions[0].young_pa, 30000);
  EXPECT_FALSE(regions[0].poisson);
  EXPECT_EQ(regions[1].box, (std::vector<double>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(regions[1].poisson, 0.3);
  EXPECT_FALSE(regions[1].label);
  EXPECT_EQ(regions[2].ball, (std::vector<double>{0.01, 0, 0.02, 0.005}));
  EXPECT_EQ(regions[2].density_kg_m3, 1200);
}

TEST(SceneParts, RegionsThatSayTooLittleOrTooMuchAreRefused) {
  const auto refusal = [](const std::string& keys) {
    return message_of(write_scene(with("[[tools]]", "[[organs.regions]]\n" + keys + "\n[[tools]]")));
  };
  const std::string where = ":9: organs[0].regions[0].";
  EXPECT_THAT(refusal("young_pa = 1"),
              HasSubstr(where + "label: found none or several of label, box and ball"));
  EXPECT_THAT(refusal("label = 1\nball = [0, 0, 0, 1]\nyoung_pa = 1"), HasSubstr("none or several"));
  EXPECT_THAT(refusal("label = 1"),
              HasSubstr(where + "young_pa: found nothing, nor poisson or density_kg_m3"));
  EXPECT_THAT(refusal("label = 1.5\nyoung_pa = 1"), HasSubstr("label: found 1.5, expected a whole number"));
  EXPECT_THAT(refusal("ball = [0, 0, 0, 0]\nyoung_pa = 1"), HasSubstr("ball: found a radius of 0"));
  EXPECT_THAT(refusal("ball = [0, 0, 0]\nyoung_pa = 1"), HasSubstr("expected a list of 4 numbers"));
  EXPECT_THAT(refusal("box = [0, 0, 0, 1, 1, \"x\"]\nyoung_pa = 1"),
              HasSubstr("expected a list of 6 numbers"));
  EXPECT_THAT(refusal("label = 1\npoisson = 0.5"),
              HasSubstr("poisson: found 0.5, expected a number above -1 and below"));
  EXPECT_THAT(refusal("label = 1\nyuong_pa = 1"), HasSubstr("yuong_pa: found an unknown key"));
}

TEST(SceneParts, AScoreNamesTheOrganThatIsToBeExposed) {
  const Scene scene = load_scene(write_scene(with("[[tools]]", "[[tools]]")));
  EXPECT_TRUE(scene.score.exposed_organ.empty());
  const std::string scored =
      with("[[organs]]", "[score]\nexposed_organ = \"" + scene.organs[0].name + "\"\n[[organs]]");
  EXPECT_EQ(load_scene(write_scene(scored)).score.exposed_organ, scene.organs[0].name);
  EXPECT_THAT(message_of(write_scene(with("[[organs]]", "[score]\nexposed_organ = \"colon\"\n[[organs]]"))),
              HasSubstr("score.exposed_organ: found \"colon\", expected the name of one of the [[organs]]"));
  EXPECT_EQ(scene.score.from_s, 0);
  EXPECT_EQ(load_scene(write_scene(with("[[organs]]", "[score]\nfrom_s = 4.5\n[[organs]]"))).score.from_s,
            4.5);
  EXPECT_THAT(message_of(write_scene(with("[[organs]]", "[score]\nfrom_s = -1\n[[organs]]"))),
              HasSubstr("score.from_s: found -1"));
  EXPECT_THAT(message_of(write_scene(with("[[organs]]", "[score]\nexposed = 1\n[[organs]]"))),
              HasSubstr("score.exposed: found an unknown key"));
}

TEST(SceneParts, AScorePlansACutAlongAnOrgan) {
  const auto scored = [](const std::string& keys) {
    return write_scene(with("[[organs]]", "[score]\n" + keys + "\n[[organs]]"));
  };
  const std::string line = "planned_line = [[0, 0, 0.1], [0.02, 0, 0.1], [0.02, 0.03, 0.1]]";
  const ScoreSpec score = load_scene(scored(line + "\nline_width_m = 0.004\npull_limit_n = 3")).score;
  EXPECT_EQ(score.planned_line.size(), 3u);
  EXPECT_EQ(score.line_of, "liver") << "the first organ";
  EXPECT_EQ(score.line_width_m, 0.004);
  EXPECT_EQ(score.pull_limit_n, 3);
  EXPECT_TRUE(load_scene(scored("from_s = 0")).score.planned_line.empty());
  const auto refusal = [&](const std::string& keys) { return message_of(scored(keys)); };
  EXPECT_THAT(refusal("planned_line = [[0, 0, 0.1]]"),
              HasSubstr("score.planned_line: found 1 points, expected two or more"));
  EXPECT_THAT(refusal("planned_line = [[0, 0, 0.1], [0, 0, 0.1]]"),
              HasSubstr("score.planned_line: found points 0 and 1 in one place"));
  EXPECT_THAT(refusal("planned_line = [[0, 0, 0.1], [0, 0, \"x\"]]"), HasSubstr("score.planned_line"));
  EXPECT_THAT(refusal(line + "\nline_of = \"spleen\""),
              HasSubstr("score.line_of: found \"spleen\", expected the name of one of the [[organs]]"));
  EXPECT_THAT(refusal("line_of = \"liver\""),
              HasSubstr("score.line_of: found one without a line, expected planned_line beside it"));
  EXPECT_THAT(refusal(line + "\nline_width_m = 1"), HasSubstr("score.line_width_m: found 1"));
  EXPECT_THAT(refusal("pull_limit_n = 0"), HasSubstr("score.pull_limit_n: found 0"));
}

TEST(SceneParts, JawsGripSoHard) {
  const auto grasper = [](const std::string& keys) {
    return write_scene(with("shape = \"probe\"", "shape = \"grasper\"\n" + keys));
  };
  EXPECT_EQ(load_scene(grasper("")).tools[0].grip_force_n, kGripForce_n);
  EXPECT_EQ(load_scene(grasper("grip_force_n = 8")).tools[0].grip_force_n, 8);
  EXPECT_THAT(message_of(grasper("grip_force_n = 0")), HasSubstr("grip_force_n: found 0"));
  EXPECT_THAT(message_of(write_scene(with("shape = \"probe\"", "shape = \"probe\"\ngrip_force_n = 5"))),
              HasSubstr("grip_force_n: found an unknown key"))
      << "of a probe";
}

TEST(SceneParts, ACuttingToolHasAnEdgeAndAHandMayPressItsButton) {
  const std::string cutting = with("shape = \"probe\"", R"(shape = "probe"
cuts = true
edge = [[0, 0, 0], [0, 0, 0.012]])");
  const Scene scene = load_scene(write_scene(cutting + "cut = true\n"));
  ASSERT_EQ(scene.tools[0].edge.size(), 2u);
  EXPECT_EQ(scene.tools[0].edge[1], Vec3(0, 0, 0.012));
  EXPECT_TRUE(scene.hands[0].cut);
  const Scene blunt = load_scene(write_scene(kGood));
  EXPECT_TRUE(blunt.tools[0].edge.empty());
  EXPECT_FALSE(blunt.hands[0].cut);
}

TEST(SceneParts, AnEdgeThatIsNoneIsRefused) {
  const auto refusal = [](const std::string& keys) {
    return message_of(write_scene(with("shape = \"probe\"", "shape = \"probe\"\n" + keys)));
  };
  EXPECT_THAT(refusal("cuts = 1"), HasSubstr(":13: tools[0].cuts: found 1, expected true or false"));
  EXPECT_THAT(refusal("cuts = true"), HasSubstr("tools[0].edge: "));
  EXPECT_THAT(
      refusal("edge = [[0, 0, 0], [0, 0, 0.01]]"),
      HasSubstr(":13: tools[0].edge: found an edge of a tool that does not cut, expected cuts = true"));
  EXPECT_THAT(refusal("cuts = true\nedge = [[0, 0, 0]]"), HasSubstr("found 1 points, expected two"));
  EXPECT_THAT(refusal("cuts = true\nedge = [[0, 0, 1], [0, 0, 1]]"), HasSubstr("an edge of 0"));
  EXPECT_THAT(refusal("cuts = true\nedge = [[0, 0, 0], [0, 0, 12]]"), HasSubstr("an edge of 12"));
  EXPECT_THAT(message_of(write_scene(kGood + "cut = true\n")),
              HasSubstr("hands[0].cut: found true with a tool that does not cut"));
}

}  // namespace
}  // namespace omentum::scene
