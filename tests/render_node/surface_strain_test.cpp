// How far a surface is stretched, and that the picture shows it only when asked.
#include "render_node/surface_strain.h"

#include "box_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr float kFloat = 1e-5f;

/// The surface of a box, moved.
struct Moved {
  explicit Moved(const Eigen::Matrix3f& map, const Vec3f& by = Vec3f::Zero()) {
    for (const geometry::Vec3& p : box.rest) {
      rest.push_back(p.cast<float>());
      now.emplace_back(map * rest.back() + by);
    }
    strain.resize(rest.size(), -1);
    surface_strain(box.surface.triangles, rest, now, strain);
  }
  OrganShape box = test::box_organ(3);
  std::vector<Vec3f> rest, now;
  std::vector<float> strain;
};

TEST(SurfaceStrain, RigidMotionHasNone) {
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(2.1f, Vec3f(1, -2, 3).normalized()).toRotationMatrix();
  for (const float strain : Moved(turn, {0.3f, -1, 2}).strain) EXPECT_NEAR(strain, 0, 2 * kFloat);
}

TEST(SurfaceStrain, IsTheLargerChangeOfLengthWhateverTheTurn) {
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.7f, Vec3f(3, 1, 1).normalized()).toRotationMatrix();
  for (const float strain : Moved(turn * (Eigen::Matrix3f::Identity() * 1.2f)).strain)
    EXPECT_NEAR(strain, 0.2f, kFloat);
  for (const float strain : Moved(turn * (Eigen::Matrix3f::Identity() * 0.9f)).strain)
    EXPECT_NEAR(strain, 0.1f, kFloat);
}

TEST(SurfaceStrain, OfAShearIsThatOfItsPrincipalStretch) {
  // F = [1 g; 0 1]: lambda^2 = 1 + g^2 / 2 + g sqrt(1 + g^2 / 4)
  constexpr float g = 0.4f;
  Eigen::Matrix3f shear = Eigen::Matrix3f::Identity();
  shear(0, 1) = g;
  const float longest = std::sqrt(1 + g * g / 2 + g * std::sqrt(1 + g * g / 4)) - 1;
  const Moved moved(shear);
  for (std::size_t s = 0; s < moved.rest.size(); ++s) {
    const bool inside_top = moved.rest[s].z() > 0.099f && moved.rest[s].head<2>().minCoeff() > 0.01f &&
                            moved.rest[s].head<2>().maxCoeff() < 0.09f;
    if (inside_top) {
      EXPECT_NEAR(moved.strain[s], longest, kFloat);
    }
  }
}

TEST(SurfaceStrain, ANodeWithoutTrianglesHasNone) {
  std::vector<float> strain{1};
  surface_strain({}, std::vector<Vec3f>(1, Vec3f::Zero()), std::vector<Vec3f>(1, Vec3f::Ones()), strain);
  EXPECT_EQ(strain[0], 0);
}

TEST(SurfaceStrain, TheMapIsDrawnWhenAskedForAndOfTheLastStateAtOnce) {
  const OrganShape box = test::box_organ(4);
  scene::Scene scene;
  scene.tools.emplace_back();
  RecordingRenderer renderer;
  SceneView view(scene, {box}, renderer);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  test::Cutter cutter(box);
  cutter.cut(test::in_slit);
  ASSERT_TRUE(view.show(0, cutter.removed(), cutter.state([](const Vec3& p) { return Vec3(0.1 * p); })));
  const auto organs = [&] {
    std::vector<DrawItem> items = view.frame(choices, std::vector<ToolNow>(1), 0).items;
    std::erase_if(items, [](const DrawItem& item) { return item.look == Look::kGround; });
    return items;
  };
  for (const DrawItem& item : organs())
    for (const Vertex& v : renderer.mesh_of(item).vertices) EXPECT_EQ(v.strain, 0);
  choices.strain = true;
  view.map_strain(true);
  ASSERT_EQ(organs().size(), 2u);
  for (const DrawItem& item : organs()) {
    EXPECT_EQ(item.look, Look::kStrain);
    const MeshData& mesh = renderer.mesh_of(item);
    for (const MeshTriangle& t : mesh.triangles) {
      if (t[0] == t[1]) continue;  // gone
      EXPECT_NEAR(mesh.vertices[t[0]].strain, 0.1f, 1e-4f);
    }
  }
}

}  // namespace
}  // namespace omentum::render
