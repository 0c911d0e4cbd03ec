// What is drawn before and over what.
#include "render_node/draw_order.h"
#include "gut_organ.h"
#include "recording_renderer.h"
#include "render_node/back_to_front.h"
#include "render_node/scene_view.h"
#include "render_node/tube_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::render {
namespace {

std::vector<MeshTriangle> sorted_triangles(std::span<const MeshTriangle> triangles) {
  std::vector<MeshTriangle> sorted(triangles.begin(), triangles.end());
  std::ranges::sort(sorted);
  return sorted;
}

/// Of the triangles that face the eye: their distances from it, in the order of drawing.
std::vector<float> distances(const MeshData& mesh, std::span<const MeshTriangle> triangles,
                             const Vec3f& eye) {
  std::vector<float> away;
  for (const auto& [a, b, c] : triangles) {
    const Vec3f p = mesh.vertices[a].position, q = mesh.vertices[b].position, r = mesh.vertices[c].position;
    const bool faces = (q - p).cross(r - p).dot(eye - p) > 0;
    EXPECT_TRUE(faces || away.empty()) << "what faces away comes first";
    if (faces) away.push_back(((p + q + r) / 3 - eye).norm());
  }
  return away;
}

TEST(BackToFront, TheFarthestTriangleComesFirstFromWhereverItIsSeen) {
  const auto drawing = make_tube_drawing(test::gut_shape(30), tissue_material("gut"));
  const MeshData& sheet = *drawing->parts().front().mesh;
  BackToFront order;
  for (const Vec3f& eye : {Vec3f(0.2f, -0.3f, 0.3f), Vec3f(-0.1f, 0.4f, -0.2f)}) {
    const std::span<const MeshTriangle> ordered = order.order(sheet, eye);
    const std::vector<float> away = distances(sheet, ordered, eye);
    EXPECT_GT(away.size(), sheet.triangles.size() / 4);
    for (std::size_t i = 1; i < away.size(); ++i) EXPECT_LE(away[i], away[i - 1] + 1e-6f);
    EXPECT_EQ(sorted_triangles(ordered), sorted_triangles(sheet.triangles)) << "each of them once";
  }
}

TEST(BackToFront, AFrameHasTheMesenteryOfItsOwnView) {
  std::vector<std::unique_ptr<OrganDrawing>> organs;
  organs.push_back(make_tube_drawing(test::gut_shape(30), tissue_material("gut")));
  RecordingRenderer renderer;
  SceneView view({}, std::move(organs), renderer);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  for (const double height : {0.2, -0.3}) {
    choices.orbit.eye.z() += height;
    const Frame frame = view.frame(choices, {}, 0);
    view.order_translucent(frame);
    const auto sheet = std::ranges::find(frame.items, Look::kMesentery, &DrawItem::look);
    ASSERT_NE(sheet, frame.items.end());
    const MeshData& mesh = renderer.mesh_of(*sheet);
    const std::vector<float> away = distances(mesh, mesh.triangles, frame.view.eye);
    EXPECT_TRUE(std::ranges::is_sorted(away, std::greater<>(), [](float d) { return d; }));
  }
}

TEST(DrawOrder, EachLookIsDrawnOnceOrIsLeftOutOfCoarseFrames) {
  for (const Quality quality : {Quality::kFine, Quality::kPlain, Quality::kCoarse}) {
    for (int look = 0; look <= static_cast<int>(Look::kSignal); ++look) {
      const auto is = [&](Look other) { return other == static_cast<Look>(look); };
      const auto times = std::ranges::count_if(opaque_looks(quality), is) +
                         std::ranges::count_if(blended_looks(quality), is);
      const bool spared = quality == Quality::kCoarse && static_cast<Look>(look) == Look::kSmoke;
      EXPECT_EQ(times, spared ? 0 : 1) << look;
    }
  }
}

TEST(DrawOrder, CoarseFramesBlendNothing) {
  EXPECT_TRUE(blended_looks(Quality::kCoarse).empty());
  EXPECT_EQ(blended_looks(Quality::kFine).back(), Look::kSmoke) << "over the mesentery";
}

TEST(DrawOrder, WhatLightGoesThroughDoesNotDarkenWhatIsBehind) {
  EXPECT_FALSE(casts_shadow(Look::kMesentery));
  EXPECT_FALSE(casts_shadow(Look::kSmoke));
  EXPECT_TRUE(casts_shadow(Look::kGut));
}

}  // namespace
}  // namespace omentum::render
