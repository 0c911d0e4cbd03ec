// What OpenGL makes of a gut, off-screen.
#include "gut_organ.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/scene_view.h"
#include "render_node/tube_drawing.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr Size kTubePicture{320, 240};

/// The colour where a place of W is seen.
Eigen::Array3i colour_at(const Picture& picture, const View& view, const Vec3& place) {
  const Vec3f p =
      view.eye_from_W.topLeftCorner<3, 3>() * place.cast<float>() + view.eye_from_W.topRightCorner<3, 1>();
  const Vec3f clip = (view.clip_from_eye * p.homogeneous()).hnormalized();
  const auto x = static_cast<int>(kTubePicture.width * (0.5f + 0.5f * clip.x()));
  const auto y = static_cast<int>(kTubePicture.height * (0.5f - 0.5f * clip.y()));
  const std::uint8_t* rgb = &picture.rgba[4 * static_cast<std::size_t>(y * kTubePicture.width + x)];
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(GutDrawing, IsPinkAndItsMesenteryYellow) {
  std::unique_ptr<Renderer> renderer;
  try {
    renderer = gl::open_offscreen(kTubePicture);
  } catch (const gl::DisplayError& error) {
    GTEST_SKIP() << error.what();
  }
  const geometry::GutShape gut = test::gut_shape();
  std::vector<std::unique_ptr<OrganDrawing>> organs;
  organs.push_back(make_tube_drawing(gut, tissue_material("gut")));
  scene::Scene scene;
  constexpr std::int32_t kTurn = 44;  // a column in a bend's middle, beside the vessel
  const Vec3 on_wall = gut.positions[kTurn] + Vec3(0, 0, gut.tube_radius_m);
  const Vec3 on_sheet = gut.positions[static_cast<std::size_t>(gut.layout.mass(1, kTurn))];
  scene.camera.target = 0.5 * (on_wall + on_sheet);
  scene.camera.eye = scene.camera.target + Vec3(0, -0.02, 0.2);
  SceneView view(scene, std::move(organs), *renderer);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  Frame frame = view.frame(choices, {}, 0);
  renderer->begin_frame();
  renderer->draw(frame);
  const Picture picture = renderer->read_back();
  renderer->end_frame();

  Eigen::Array3i wall = Eigen::Array3i::Zero();  // of several places: one may mirror a lamp
  for (const std::int32_t column : {kTurn - 4, kTurn - 2, kTurn, kTurn + 2, kTurn + 4})
    wall += colour_at(picture, frame.view,
                      gut.positions[static_cast<std::size_t>(column)] + Vec3(0, 0, gut.tube_radius_m));
  wall /= 5;
  const Eigen::Array3i sheet = colour_at(picture, frame.view, on_sheet);
  EXPECT_GT(wall[0], wall[1] + 10) << wall.transpose();
  EXPECT_LT(std::abs(wall[1] - wall[2]), 40) << "pink, not yellow: " << wall.transpose();
  EXPECT_GT(sheet[0] + sheet[1], 2 * sheet[2] + 30) << "yellow: " << sheet.transpose();
  EXPECT_GT(sheet.maxCoeff(), 60) << "and no ground";
}

}  // namespace
}  // namespace omentum::render
