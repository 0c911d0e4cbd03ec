// The scene's nodule on the map of its organ, and the program that draws it.
#include "organ_tools/force_map/press_map.h"
#include "scene/scene.h"
#include "tests/support/scene_organ.h"

#include <gmock/gmock.h>

#include <cmath>

namespace omentum::force_map {
namespace {

using testing::HasSubstr;

class NoduleMap : public testing::Test {
 protected:
  // Made once, and left as they are.
  static void SetUpTestSuite() {
    organs_ = std::make_unique<test::ScratchFolder>();
    for (const char* sub : {"with", "without"}) std::filesystem::create_directories(*organs_ / sub);
    const auto with = test::build_scene_organs("nodule", test::Regions::kOfTheScene, *organs_ / "with");
    const auto without = test::build_scene_organs("nodule", test::Regions::kNone, *organs_ / "without");
    nodule = with.value_or("");
    plain = without.value_or("");
  }
  static void TearDownTestSuite() { organs_.reset(); }
  void SetUp() override {
    if (nodule.empty()) GTEST_SKIP() << "organ_phantom is absent";
  }
  static scene::Scene scene() { return scene::load_scene(*organs_ / "with" / "nodule.toml"); }

  test::ScratchFolder folder;
  static inline std::string nodule, plain;

 private:
  static inline std::unique_ptr<test::ScratchFolder> organs_;
};

TEST_F(NoduleMap, TheRatioIsHighestAboveTheNoduleAndTellsItsSize) {
  const std::vector<double> ball = scene().organs.at(0).regions.at(0).ball;
  const Vec3 centre(ball.data());
  const double radius_m = ball.at(3);
  const organ::Organ a = organ::load_organ(nodule, organ::Load::kWithTensors);
  const organ::Organ b = organ::load_organ(plain, organ::Load::kWithTensors);
  const Indenter thumb;
  const std::vector<double> ratio = ratio_of(a, press_everywhere(a, thumb), b, press_everywhere(b, thumb));
  const auto peak = peak_of(a, ratio, 1);
  ASSERT_TRUE(peak);
  const std::vector<Vec3> x = geometry::surface_positions(a.mesh, a.surface);
  const Vec3 n = geometry::surface_normals(a.surface, x)[peak->node], from = x[peak->node] - centre;
  EXPECT_GT(from.dot(n), radius_m) << "over the nodule, which does not reach the surface";
  EXPECT_LE((from - from.dot(n) * n).norm(), radius_m) << "straight above it";
  EXPECT_GT(peak->value, 1.3);
  // a thumb of 15 mm widens what lies 5 mm deep
  constexpr double kSizeFactor = 1.4;
  EXPECT_GT(peak->diameter_m(), 2 * radius_m / kSizeFactor);
  EXPECT_LT(peak->diameter_m(), 2 * radius_m * kSizeFactor);
  for (std::size_t s = 0; s < ratio.size(); ++s) {
    if (!std::isfinite(ratio[s])) continue;
    EXPECT_GT(ratio[s], 1 - 1e-4) << "nowhere is it softer";
    if ((x[s] - centre).norm() > 4 * radius_m) {
      EXPECT_LT(ratio[s], 1 + 0.1 * (peak->value - 1)) << "hidden from afar";
    }
  }
}

TEST_F(NoduleMap, TheProgramSaysPlaceAndSizeAndWritesBothFiles) {
  const std::string prefix = folder / "map";
  test::Process program("force_map",
                        {nodule, "--compare", plain, "--outline", "--from", "-0.3,-0.5,0.8", "-o", prefix});
  ASSERT_EQ(program.wait(), 0) << program.messages();
  EXPECT_EQ(program.messages(), "");
  EXPECT_THAT(program.output(), HasSubstr("nodule: ratio to nodule: 1.000 to 1."));
  EXPECT_THAT(program.output(), HasSubstr("white line: half of the excess there"));
  EXPECT_THAT(test::read_text(prefix + ".vtu"), HasSubstr("Name=\"ratio\""));
  EXPECT_THAT(test::read_text(prefix + ".png"), testing::StartsWith("\x89PNG"));
}

TEST_F(NoduleMap, AnOrganThatIsNowhereHarderHasNoPeak) {
  for (const std::string& softer : {plain, nodule}) {
    test::Process program("force_map", {plain, "--compare", softer, "-o", folder / "map"});
    ASSERT_EQ(program.wait(), 0) << program.messages();
    EXPECT_THAT(program.output(), HasSubstr("1.000: nowhere harder"));
    EXPECT_THAT(program.output(), testing::Not(HasSubstr("white line")));
  }
}

TEST_F(NoduleMap, WhatCannotBePressedOrReadIsRefusedInOneLine) {
  const std::string prefix = folder / "map";
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", prefix});
    test::Process program("force_map", arguments);
    EXPECT_EQ(program.wait(), 2);
    EXPECT_FALSE(std::filesystem::exists(prefix + ".vtu"));
    EXPECT_FALSE(std::filesystem::exists(prefix + ".png"));
    const std::string said = program.messages();
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    return said;
  };
  EXPECT_THAT(refusal({nodule, "--from", "0,0,0"}), HasSubstr("--from 0,0,0: expected a direction"));
  EXPECT_THAT(refusal({nodule, "--radius", "0.01", "--depth", "0.02"}),
              HasSubstr("--depth 0.02: expected at most the --radius, 0.01 m"));
  EXPECT_THAT(refusal({folder / "none.h5"}), HasSubstr("none.h5"));
  std::filesystem::create_directory(prefix + ".png");
  test::Process blocked("force_map", {nodule, "-o", prefix});
  EXPECT_EQ(blocked.wait(), 2);
  EXPECT_THAT(blocked.messages(), HasSubstr("map.png"));
  EXPECT_FALSE(std::filesystem::exists(prefix + ".vtu")) << "none of both, where one cannot be written";
  std::filesystem::remove(prefix + ".png");
  std::string content = test::read_text(nodule);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 8);
  std::ofstream(folder / "damaged.h5", std::ios::binary) << content;
  EXPECT_THAT(refusal({folder / "damaged.h5"}), HasSubstr("its tensors are damaged (checksum"));
}

}  // namespace
}  // namespace omentum::force_map
