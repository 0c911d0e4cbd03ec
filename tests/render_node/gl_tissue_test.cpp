// Pixels of what tissue does: it pales, bleeds, smokes, and a mesentery lets light through.
#include "box_organ.h"
#include "gut_organ.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/tube_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr Size kTissueSize{320, 240};

/// The mean colour of a few pixels around where a place of W is seen.
Eigen::Array3d mean_around(const Picture& picture, const View& view, const Vec3& place) {
  const Eigen::Vector4f clip = view.clip_from_eye * (view.eye_from_W * place.cast<float>().homogeneous());
  const auto x = static_cast<int>(kTissueSize.width * (0.5f + 0.5f * clip.x() / clip.w()));
  const auto y = static_cast<int>(kTissueSize.height * (0.5f - 0.5f * clip.y() / clip.w()));
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  constexpr int kReach = 3;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      const auto i = 4 * static_cast<std::size_t>((y + dy) * kTissueSize.width + x + dx);
      sum += Eigen::Array3d(picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]);
    }
  }
  return sum / ((2 * kReach + 1) * (2 * kReach + 1));
}

class TissueDrawing : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kTissueSize);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  Picture draw(const Frame& frame) {
    renderer_->begin_frame();
    renderer_->draw(frame);
    Picture picture = renderer_->read_back();
    renderer_->end_frame();
    return picture;
  }
  std::unique_ptr<Renderer> renderer_;
};

TEST_F(TissueDrawing, PressedTissueIsPalerAndLessRedAndTheRestStays) {
  const OrganShape box = test::box_organ(6);
  scene::Scene scene;
  scene.camera.eye = {0.05, -0.10, 0.30};
  scene.camera.target = {0.05, 0.05, 0.08};
  SceneView view(scene, std::vector{box}, *renderer_);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  const Frame frame = view.frame(choices, {}, 0);
  const Vec3 pressed(0.05, 0.05, 0.1), beside(0.015, 0.05, 0.1);
  const Picture before = draw(frame);
  std::uint32_t node = 0;
  for (std::uint32_t f = 0; f < box.surface_of_file_node.size(); ++f) {
    const auto s = box.surface_of_file_node[f];
    if (s.valid() && (box.rest[static_cast<std::size_t>(s)] - pressed).norm() < 1e-6) node = f;
  }
  view.live(0, std::vector<NodeForce>{{node, {0, 0, -3}}}, 1);
  view.refresh(0);
  const Picture after = draw(frame);
  const Eigen::Array3d red = mean_around(before, frame.view, pressed),
                       pale = mean_around(after, frame.view, pressed);
  EXPECT_GT(pale[1], red[1] + 25) << red.transpose() << " to " << pale.transpose();
  EXPECT_LT(pale[0] / pale[1], 0.75 * red[0] / red[1]);
  EXPECT_LT(
      (mean_around(before, frame.view, beside) - mean_around(after, frame.view, beside)).abs().maxCoeff(), 2);
}

TEST_F(TissueDrawing, SmokeIsSeenAndAbsentFromCoarseFrames) {
  scene::Scene scene;
  scene.camera.eye = {0.05, -0.10, 0.30};
  scene.camera.target = {0.05, 0.05, 0.08};
  scene.tools.emplace_back();
  SceneView view(scene, std::vector{test::box_organ(3)}, *renderer_);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  const Vec3 at(0.05, 0.05, 0.105);
  std::vector<ToolNow> tools(1);
  tools[0].seen = true;
  tools[0].p_WT = {0, 0, 5};  // out of sight
  tools[0].burning_at = at;
  for (const Quality quality : {Quality::kFine, Quality::kCoarse}) {
    Frame clear = view.frame(choices, std::vector<ToolNow>(1), 0), smoky = clear;
    clear.quality = smoky.quality = quality;
    view.smoke(tools, 0.4);
    smoky.items = view.frame(choices, std::vector<ToolNow>(1), 0).items;
    const Picture without = draw(clear), with = draw(smoky);
    const double change =
        (mean_around(with, clear.view, at) - mean_around(without, clear.view, at)).abs().maxCoeff();
    if (quality == Quality::kFine) EXPECT_GT(change, 8);
    if (quality == Quality::kCoarse) EXPECT_LT(change, 2);
    view.smoke(std::vector<ToolNow>(1), 10);
  }
}

TEST_F(TissueDrawing, WhatLiesBehindAMesenteryShowsThrough) {
  const geometry::GutShape gut = test::gut_shape();
  std::vector<std::unique_ptr<OrganDrawing>> organs;
  organs.push_back(make_tube_drawing(gut, tissue_material("gut")));
  scene::Scene scene;
  const Vec3 on_sheet = gut.positions[static_cast<std::size_t>(gut.layout.mass(1, 44))];
  scene.camera.target = on_sheet;
  scene.camera.eye = on_sheet + Vec3(0, -0.02, 0.2);
  SceneView view(scene, std::move(organs), *renderer_);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  Frame plain = view.frame(choices, {}, 0);
  // a plate behind it
  MeshData plate;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vertex& vertex = plate.vertices.emplace_back();
    vertex.position = (on_sheet + Vec3(0.03 * x, 0.03 * y, -0.012)).cast<float>();
    vertex.normal = Vec3f::UnitZ();
  }
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshId mesh = renderer_->add_mesh(plate);
  const auto seen_before = [&](float grey, Quality quality) {
    Frame frame = plain;
    frame.quality = quality;
    frame.items.push_back({mesh, Look::kSolid, Mat4f::Identity(), {Vec3f::Constant(grey), 0, 1}});
    return mean_around(draw(frame), frame.view, on_sheet).mean();
  };
  EXPECT_GT(seen_before(0.9f, Quality::kFine), seen_before(0.02f, Quality::kFine) + 12);
  EXPECT_NEAR(seen_before(0.9f, Quality::kCoarse), seen_before(0.02f, Quality::kCoarse), 3) << "opaque";
}

/// How much the hue (green over red) of what is drawn changes from a pixel to one a few pixels on, in the
/// mean.
double variety(const Picture& picture, const Picture& backdrop) {
  constexpr std::size_t kStep = 4 * 6;  // two pixels of the coarsest picture
  const auto is_drawn = [&](std::size_t i) {
    return !std::equal(&picture.rgba[i], &picture.rgba[i + 3], &backdrop.rgba[i]);
  };
  const auto hue = [&](std::size_t i) {
    return picture.rgba[i + 1] / std::max(1.0, static_cast<double>(picture.rgba[i]));
  };
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i + kStep < picture.rgba.size(); i += 4) {
    if (!is_drawn(i) || !is_drawn(i + kStep)) continue;
    sum += std::abs(hue(i) - hue(i + kStep));
    ++count;
  }
  return sum / std::max(1, count);
}

// Vessels and fat are narrower than the triangles of the coarsest pictures.
TEST_F(TissueDrawing, AMesenteryKeepsItsVesselsInTheCoarsestPictures) {
  std::vector<std::unique_ptr<OrganDrawing>> organs;
  organs.push_back(make_tube_drawing(test::gut_shape(), tissue_material("gut")));
  SceneView view({}, std::move(organs), *renderer_);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  Frame sheet = view.frame(choices, {}, 0);
  sheet.tubes.clear();
  std::erase_if(sheet.items, [](const DrawItem& item) { return item.look != Look::kMesentery; });
  Frame nothing = sheet, plain = sheet;
  nothing.items.clear();
  plain.items.front().look = Look::kTissue;
  const auto seen = [&](Frame frame, Quality quality) {
    frame.quality = nothing.quality = quality;
    return variety(draw(frame), draw(nothing));
  };
  const double much = 0.5 * seen(sheet, Quality::kFine);
  for (const Quality quality : {Quality::kDraft, Quality::kSketch, Quality::kFaint}) {
    EXPECT_GT(seen(sheet, quality), much) << static_cast<int>(quality);
    EXPECT_LT(seen(plain, quality), much) << "of tissue that has none, " << static_cast<int>(quality);
  }
}

}  // namespace
}  // namespace omentum::render
