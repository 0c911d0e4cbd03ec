#include "ball_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::render {
namespace {

constexpr double kRadius = 0.05;

/// A toy of a kind of its own: a pyramid whose top is the state's one node, and which nobody dents.
class Pyramid final : public OrganDrawing {
 public:
  explicit Pyramid(const Vec3& middle) {
    for (const Vec3& corner : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, -1, 0), Vec3(0, 0, 1)}) {
      outline_.points.push_back(middle + kRadius * corner);
      outline_.normals.push_back(corner.normalized().cast<float>());
      mesh_.vertices.emplace_back().position = outline_.points.back().cast<float>();
    }
    outline_.area_m2 = 4 * kRadius * kRadius;
    mesh_.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  }
  Outline outline() const override { return outline_; }
  void deform(std::span<const float> values) override {
    mesh_.vertices.back().position = Vec3f(values[0], values[1], values[2]);
  }
  const MeshData& mesh() const override { return mesh_; }
  Material material() const override { return {{0, 1, 0}, 0, 1}; }

 private:
  Outline outline_;
  MeshData mesh_;
};

/// A ball and, beside it, the toy.
struct DrawnStage {
  DrawnStage() : view(scene, organs(), renderer) { choices.orbit = view.first_camera(); }
  static std::vector<std::unique_ptr<OrganDrawing>> organs() {
    std::vector<std::unique_ptr<OrganDrawing>> organs;
    organs.push_back(make_drawing(test::ball_organ(kRadius, 2)));
    organs.push_back(std::make_unique<Pyramid>(Vec3(0.2, 0, 0)));
    return organs;
  }
  std::vector<DrawItem> tissue() {
    std::vector<DrawItem> items;
    for (const DrawItem& item : view.frame(choices, std::vector<ToolNow>(1), 0).items)
      if (item.look == Look::kTissue) items.push_back(item);
    return items;
  }
  scene::Scene scene = test::scene_with({"probe"});
  RecordingRenderer renderer;
  SceneView view;
  ViewChoices choices;
};

TEST(OrganDrawing, ATetrahedralMeshIsDrawnAsItsSurface) {
  const OrganShape ball = test::ball_organ(kRadius, 2);
  const auto drawing = make_drawing(ball);
  ASSERT_NE(drawing->surface(), nullptr);
  EXPECT_EQ(drawing->surface()->skin.node_count(), static_cast<std::int32_t>(ball.rest.size()));
  EXPECT_EQ(drawing->surface()->node(test::kFirstFileNode), geometry::SurfaceId(0));
  EXPECT_FALSE(drawing->surface()->node(0).valid()) << "it is inside";
  EXPECT_FALSE(drawing->surface()->node(0xffffffff).valid());
}

TEST(OrganDrawing, AToyOfAnotherKindIsDrawnBesideIt) {
  DrawnStage stage;
  const std::vector<DrawItem> tissue = stage.tissue();
  ASSERT_EQ(tissue.size(), 2u);
  EXPECT_EQ(tissue[1].material.colour, Vec3f(0, 1, 0));
  EXPECT_GE(stage.view.ball().radius, 0.1) << "the camera has both in view";
  stage.view.deform(1, std::vector<float>{1, 2, 3});
  EXPECT_EQ(stage.renderer.mesh_of(tissue[1]).vertices.back().position, Vec3f(1, 2, 3));
}

TEST(OrganDrawing, WhatHasNoSurfaceIsNotDentedAndHidesDentsAllTheSame) {
  DrawnStage stage;
  EXPECT_EQ(stage.view.surface(1), nullptr);
  ToolNow tool = test::tool_at(Vec3(0.2, 0, kRadius), Vec3(0, 0, 1));
  tool.contact_organ = 1;
  tool.contact_nodes = {0};
  tool.contact_forces_n = {1};
  EXPECT_FALSE(stage.view.dent_of(tool).has_value());
  stage.choices.markers = true;
  const Frame frame = stage.view.frame(stage.choices, std::vector<ToolNow>{tool}, 0);
  const auto signals = std::count_if(frame.items.begin(), frame.items.end(),
                                     [](const DrawItem& item) { return item.look == Look::kSignal; });
  EXPECT_EQ(signals, 2) << "the arrow, and no marker";
}

}  // namespace
}  // namespace omentum::render
