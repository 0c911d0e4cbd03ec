// The map of what tissue is under, as it is drawn.
#include "render_node/option_words.h"

#include "box_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

TEST(TissueMap, IsSwitchedThroughOffStrainAndStress) {
  EXPECT_EQ(next(TissueMap::kOff), TissueMap::kStrain);
  EXPECT_EQ(next(TissueMap::kStrain), TissueMap::kStress);
  EXPECT_EQ(next(TissueMap::kStress), TissueMap::kOff);
  EXPECT_EQ(word(TissueMap::kStress), "stress");
}

TEST(TissueMap, IsChosenByItsWord) {
  TissueMap map = TissueMap::kOff;
  EXPECT_EQ(parse_map("stress", map), "");
  EXPECT_EQ(map, TissueMap::kStress);
  EXPECT_EQ(parse_map("heat", map), "found heat, expected strain or stress");
}

TEST(TissueMap, BothScalesEndAtTheSameTension) {
  constexpr double kYoung_pa = 6000;
  EXPECT_NEAR(full_stress_pa(kYoung_pa), kYoung_pa * static_cast<double>(kFullStrain), 1e-9);
}

TEST(TissueMap, EachColourIsLighterThanTheOneBefore) {
  const auto light = [](const Vec3f& colour) { return colour.dot(Vec3f(0.2126f, 0.7152f, 0.0722f)); };
  for (std::size_t i = 1; i < kMapColourCount; ++i)
    EXPECT_GT(light(map_colours()[i]), light(map_colours()[i - 1]));
}

/// A box with a slit, whose shares are those of its nodes' heights.
class TissueMapDrawing : public testing::Test {
 protected:
  TissueMapDrawing() { cutter_.cut(test::in_slit); }
  std::vector<float> state() {
    return cutter_.state([](const Vec3& p) { return Vec3(0.1 * p); });
  }
  [[nodiscard]] bool show(float share) {
    const std::vector<float> values = state();
    const std::vector<float> shares(share < 0 ? 0 : values.size() / 3, share);
    return view_.show(0, cutter_.removed(), values, shares);
  }
  std::vector<DrawItem> organs(TissueMap map) {
    ViewChoices choices;
    choices.orbit = view_.first_camera();
    choices.map = map;
    std::vector<DrawItem> items = view_.frame(choices, std::vector<ToolNow>(1), 0).items;
    std::erase_if(items, [](const DrawItem& item) { return item.look == Look::kGround; });
    return items;
  }
  static scene::Scene scene() {
    scene::Scene scene;
    scene.tools.emplace_back();
    return scene;
  }

  const OrganShape box_ = test::box_organ(4);
  RecordingRenderer renderer_;
  SceneView view_{scene(), {box_}, renderer_};
  test::Cutter cutter_{box_};
};

TEST_F(TissueMapDrawing, SkinAndCutHaveTheirNodesShares) {
  ASSERT_TRUE(show(0.4f));
  EXPECT_TRUE(view_.mapped(0));
  const std::vector<DrawItem> drawn = organs(TissueMap::kStress);
  ASSERT_EQ(drawn.size(), 2u);
  for (const DrawItem& item : drawn) {
    EXPECT_EQ(item.look, Look::kMap);
    const MeshData& mesh = renderer_.mesh_of(item);
    for (const MeshTriangle& t : mesh.triangles) {
      if (t[0] != t[1]) {
        EXPECT_FLOAT_EQ(mesh.vertices[t[0]].share, 0.4f);
      }
    }
  }
}

TEST_F(TissueMapDrawing, AnOrganWhoseValuesNobodyToldIsTissue) {
  ASSERT_TRUE(show(-1));
  EXPECT_FALSE(view_.mapped(0));
  for (const DrawItem& item : organs(TissueMap::kStrain)) EXPECT_NE(item.look, Look::kMap);
}

TEST_F(TissueMapDrawing, AMapThatIsForgottenIsDrawnNoMoreUntilTheNextValues) {
  ASSERT_TRUE(show(0.4f));
  view_.forget_map();
  for (const DrawItem& item : organs(TissueMap::kStrain)) EXPECT_NE(item.look, Look::kMap);
  ASSERT_TRUE(show(0.2f));
  for (const DrawItem& item : organs(TissueMap::kStrain)) EXPECT_EQ(item.look, Look::kMap);
}

TEST_F(TissueMapDrawing, SwitchedOffItIsTissueThoughValuesAreKnown) {
  ASSERT_TRUE(show(0.4f));
  for (const DrawItem& item : organs(TissueMap::kOff)) EXPECT_NE(item.look, Look::kMap);
}

}  // namespace
}  // namespace omentum::render
