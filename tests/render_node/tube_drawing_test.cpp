#include "render_node/tube_drawing.h"

#include "gut_organ.h"
#include "recording_renderer.h"
#include "render_node/scene_view.h"
#include "render_node/tube_cylinder.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

std::vector<float> values_of(const geometry::GutShape& gut) {
  std::vector<float> values;
  for (const Vec3& p : gut.positions)
    for (const double x : p) values.push_back(static_cast<float>(x));
  return values;
}

struct Stage {
  Stage() : view(scene, drawing_of(gut), renderer) { choices.orbit = view.first_camera(); }
  static std::vector<std::unique_ptr<OrganDrawing>> drawing_of(const geometry::GutShape& gut) {
    std::vector<std::unique_ptr<OrganDrawing>> organs;
    organs.push_back(make_tube_drawing(gut, tissue_material("gut")));
    return organs;
  }
  DrawItem item(Look look) const {
    for (const DrawItem& item : view.frame(choices, {}, 0).items)
      if (item.look == look) return item;
    ADD_FAILURE() << "nothing drawn looks so";
    return {};
  }
  TubeItem tube() const {
    const Frame frame = view.frame(choices, {}, 0);
    return frame.tubes.size() == 1 ? frame.tubes.front() : TubeItem{};
  }
  /// The wall as a renderer would draw it.
  MeshData wall() const {
    const TubeItem item = tube();
    return skinned_tube(renderer.tubes.at(static_cast<std::size_t>(item.tube)), item.radius_m,
                        make_tube_cylinder(item.resolution.n));
  }
  geometry::GutShape gut = test::gut_shape();
  scene::Scene scene;
  RecordingRenderer renderer;
  SceneView view;
  ViewChoices choices;
};

TEST(TubeDrawing, IsATubeAndAMesenteryOfOtherMaterials) {
  Stage stage;
  EXPECT_NE(stage.tube().material.colour, stage.item(Look::kMesentery).material.colour);
  EXPECT_EQ(stage.tube().look, Look::kGut);
}

TEST(TubeDrawing, BothMoveWithAState) {
  Stage stage;
  const MeshData tube = stage.wall();
  const MeshData sheet = stage.renderer.mesh_of(stage.item(Look::kMesentery));
  for (Vec3& p : stage.gut.positions) p.z() += 0.25;
  ASSERT_TRUE(stage.view.show(0, {}, values_of(stage.gut)));
  EXPECT_NEAR(stage.wall().vertices[99].position.z(), tube.vertices[99].position.z() + 0.25f, 1e-5f);
  EXPECT_NEAR(stage.renderer.mesh_of(stage.item(Look::kMesentery)).vertices[99].position.z(),
              sheet.vertices[99].position.z() + 0.25f, 1e-5f);
}

TEST(TubeDrawing, NothingOfItLiesBelowTheGround) {
  const Stage stage;
  const float ground = stage.renderer.mesh_of(stage.item(Look::kGround)).vertices[0].position.z();
  for (const MeshData& mesh : {stage.wall(), stage.renderer.mesh_of(stage.item(Look::kMesentery))})
    for (const Vertex& v : mesh.vertices) ASSERT_GT(v.position.z(), ground);
}

TEST(TubeDrawing, TheGroundsShadeFollowsIt) {
  Stage stage;
  const auto darkest = [&] {
    const auto& vertices = stage.renderer.mesh_of(stage.item(Look::kGround)).vertices;
    return *std::ranges::min_element(vertices, {}, &Vertex::openness);
  };
  const Vertex before = darkest();
  for (Vec3& p : stage.gut.positions) p.x() += 0.4;
  stage.view.deform(0, values_of(stage.gut));
  EXPECT_EQ(darkest().position, before.position) << "it costs too much for every state";
  stage.view.shade_ground();
  EXPECT_GT(darkest().position.x(), before.position.x() + 0.1f);
  EXPECT_NEAR(darkest().openness, before.openness, 0.15f);
}

TEST(TubeDrawing, TheCameraHasAllOfItInView) {
  const Stage stage;
  for (const Vec3& p : stage.gut.positions)
    EXPECT_LT((p - stage.view.ball().centre).norm(), stage.view.ball().radius + 0.01);
}

TEST(TubeDrawing, BothAreMapped) {
  Stage stage;
  const std::vector<float> shares(stage.gut.positions.size(), 0.25f);
  ASSERT_TRUE(stage.view.show(0, {}, values_of(stage.gut), shares));
  stage.choices.map = TissueMap::kStrain;
  EXPECT_FLOAT_EQ(stage.renderer.mesh_of(stage.item(Look::kMap)).vertices[800].share, 0.25f);
  EXPECT_EQ(stage.tube().look, Look::kMap);
  EXPECT_FALSE(stage.tube().by_turn);
  EXPECT_FLOAT_EQ(stage.wall().vertices[800].share, 0.25f);
}

TEST(TubeDrawing, IsColouredByItsFoldsOnWish) {
  Stage stage;
  stage.choices.folds = true;
  EXPECT_EQ(stage.tube().look, Look::kMap);
  EXPECT_TRUE(stage.tube().by_turn);
}

TEST(TubeDrawing, SendsFramesAnewWhenItsResolutionChanges) {
  Stage stage;
  const auto frames = [&] { return stage.renderer.tubes.at(0).size(); };
  stage.view.set_tube_resolution({kCoarsestTubeEps, 0});
  const std::size_t coarse = frames();
  EXPECT_EQ(stage.view.tube_cost(), tube_cost(coarse, 0));
  const int sent = stage.renderer.updates;
  stage.view.set_tube_resolution({kCoarsestTubeEps, 2});
  EXPECT_EQ(stage.renderer.updates, sent) << "of another n, the same frames";
  EXPECT_EQ(stage.tube().resolution.n, 2);
  stage.view.set_tube_resolution({0, 99});
  EXPECT_EQ(stage.view.tube_resolution(), (TubeResolution{kFinestTubeEps, kMostTubeN})) << "its bounds";
  EXPECT_GT(frames(), coarse);
  EXPECT_EQ(stage.view.tube_cost(), tube_cost(frames(), kMostTubeN));
}

TEST(TubeDrawing, WhoLooksWithoutAPictureSeesTheStateThatIsDrawn) {
  Stage stage;
  ExposureRaster raster({80, 60});
  EXPECT_GT(stage.view.exposed_share(0, {}, raster), 0.5);
  for (Vec3& p : stage.gut.positions) p.z() += 100;
  stage.view.deform(0, values_of(stage.gut));
  EXPECT_FALSE(stage.view.exposed_share(0, {}, raster).has_value()) << "far out of sight";
}

TEST(TubeDrawing, IsNeitherDentedNorCut) {
  Stage stage;
  EXPECT_EQ(stage.view.surface(0), nullptr);
  EXPECT_EQ(stage.view.removed_count(0), 0);
  EXPECT_NEAR(stage.view.length_m(0), 1.6, 0.01);
}

}  // namespace
}  // namespace omentum::render
