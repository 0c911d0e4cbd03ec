// Small pictures against stored ones: what a change of a shader does to the looks of a scene.
// After a wanted change: OMENTUM_RENEW_REFERENCES=1 build/release/bin/render_gl_test
// --gtest_filter='ReferencePictures.*', then look at tests/render_node/references/ before it is committed.
#include "ball_organ.h"
#include "box_organ.h"
#include "gut_organ.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/png_file.h"
#include "render_node/tube_drawing.h"
#include "seen_difference.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace omentum::render {
namespace {

constexpr Size kReferenceSize{120, 80};

class ReferencePictures : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kReferenceSize);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  Picture draw(const Frame& frame) {
    renderer_->draw(frame);
    return renderer_->read_back();
  }
  Frame frame_of(SceneView& view, std::span<const ToolNow> tools) {
    ViewChoices choices;
    choices.arrows = false;
    choices.orbit = view.first_camera();
    Frame frame = view.frame(choices, tools, 0);
    frame.with_panel = false;
    view.order_translucent(frame);
    return frame;
  }
  // Wet tissue, its shadow on the drape, and an instrument's on it.
  Frame ball() {
    const OrganShape shape = test::ball_organ(0.06, 4);
    scene::Scene scene = test::scene_with({"grasper"});
    views_.push_back(std::make_unique<SceneView>(scene, std::vector{shape}, *renderer_));
    return frame_of(*views_.back(), std::vector{test::tool_at({0.02, -0.03, 0.048}, {})});
  }
  // A slit, half of it burnt: raw tissue and char.
  Frame cut() {
    const OrganShape shape = test::box_organ(6);
    scene::Scene scene;
    scene.camera.eye = {0.05, -0.10, 0.30};
    scene.camera.target = {0.05, 0.05, 0.08};
    views_.push_back(std::make_unique<SceneView>(scene, std::vector{shape}, *renderer_));
    test::Cutter cutter(shape);
    const auto slit_at = [](bool back) {
      return [back](const Vec3& p) { return test::in_slit(p) && (p.y() > 0.5 * test::kBoxSide_m) == back; };
    };
    cutter.cut(slit_at(false), false);
    cutter.cut(slit_at(true), true);
    EXPECT_TRUE(views_.back()->show(0, cutter.removed(), cutter.rest()));
    return frame_of(*views_.back(), {});
  }
  Frame gut() {
    std::vector<std::unique_ptr<OrganDrawing>> organs;
    organs.push_back(make_tube_drawing(test::gut_shape(), tissue_material("gut")));
    views_.push_back(std::make_unique<SceneView>(scene::Scene{}, std::move(organs), *renderer_));
    return frame_of(*views_.back(), {});
  }
  void expect_as_stored(const Frame& frame, const std::string& name) {
    const std::string file = OMENTUM_SOURCE_DIR "/tests/render_node/references/" + name + ".png";
    const Picture seen = draw(frame);
    if (std::getenv("OMENTUM_RENEW_REFERENCES") != nullptr) write_png(seen, file);
    const test::SeenDifference d = test::seen_difference_of(seen, read_png(file));
    EXPECT_TRUE(test::looks_same(d)) << name << ": differs by " << d.mean << ", at most " << d.worst;
  }
  std::unique_ptr<Renderer> renderer_;
  std::vector<std::unique_ptr<SceneView>> views_;
};

TEST_F(ReferencePictures, LookAsTheyAreStored) {
  Frame frame = ball();
  expect_as_stored(frame, "ball");
  frame.quality = Quality::kDraft;
  expect_as_stored(frame, "ball_draft");
  expect_as_stored(cut(), "cut");
  expect_as_stored(gut(), "gut");
}

// What a slip in a shader or a material does is found: a paler red, no glints, no shadows.
TEST_F(ReferencePictures, AChangeOfTheLooksIsFound) {
  const Frame frame = ball();
  const Picture before = draw(frame);
  EXPECT_TRUE(test::looks_same(test::seen_difference_of(before, draw(frame))));
  Frame pale = frame, dull = frame, unshaded = frame;
  for (DrawItem& item : pale.items)
    if (item.look == Look::kTissue) item.material.colour *= 1.25f;
  for (DrawItem& item : dull.items)
    if (item.look == Look::kTissue) item.material.roughness = 1;
  unshaded.quality = Quality::kFlat;
  for (const Frame* changed : {&pale, &dull, &unshaded})
    EXPECT_FALSE(test::looks_same(test::seen_difference_of(before, draw(*changed))))
        << (changed == &pale   ? "paler"
            : changed == &dull ? "without glints"
                               : "without shadows");
}

}  // namespace
}  // namespace omentum::render
