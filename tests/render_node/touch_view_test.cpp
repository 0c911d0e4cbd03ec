// Parts that touch: from the wire to marks and to the panel's line.
#include "render_node/touch_view.h"

#include "recording_renderer.h"
#include "tests/support/fake_bus.h"

#include <gmock/gmock.h>

#include <limits>

namespace omentum::render {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Of two spheres of 10 mm along x that overlap by 2 mm.
msg::TouchingPair touching(float x, float push) {
  return {.organ_one = 0,
          .organ_other = 1,
          .one_x = x,
          .other_x = x + 0.018f,
          .radius_one = 0.01f,
          .radius_other = 0.01f,
          .push = push};
}

msg::TouchingPairs moment(std::uint64_t seq, std::vector<msg::TouchingPair> pairs) {
  msg::TouchingPairs moment;
  moment.block_count = 1;
  moment.seq = seq;
  moment.touching = static_cast<std::uint32_t>(pairs.size());
  moment.pairs = std::move(pairs);
  return moment;
}

TEST(TouchBands, AreTenfoldAndEachColourIsLighterThanTheOneBefore) {
  EXPECT_EQ(touch_band(0), 0U);
  for (std::size_t b = 0; b + 1 < kTouchBands; ++b) {
    EXPECT_EQ(touch_band(0.99f * kTouchLimits_n[b]), b);
    EXPECT_EQ(touch_band(kTouchLimits_n[b]), b + 1);
    const auto light = [](const Vec3f& colour) { return colour.dot(Vec3f(0.2126f, 0.7152f, 0.0722f)); };
    EXPECT_GT(light(touch_colours()[b + 1]), light(touch_colours()[b]));
  }
  EXPECT_EQ(touch_band(1e6f), kTouchBands - 1);
}

TEST(TouchPlace, IsInTheMiddleOfWhatBothShareWhicheverIsLarger) {
  msg::TouchingPair pair = touching(0, 1);
  EXPECT_LT((touch_place(pair) - Vec3f(0.009f, 0, 0)).norm(), 1e-7f);
  pair.radius_other = 0.03f;
  pair.other_x = 0.041f;  // a gap of 1 mm from 10 to 11 mm
  EXPECT_LT((touch_place(pair) - Vec3f(0.0105f, 0, 0)).norm(), 1e-7f);
}

class TouchViewTest : public testing::Test {
 protected:
  /// What a frame has to draw.
  std::vector<DrawItem> drawn(bool on = true) {
    Frame frame;
    view_.draw(on, frame);
    return frame.items;
  }
  bool is_read() { return writer_->status().matched > 0; }

  struct Clock final : runtime::Clock {
    std::int64_t now_ns() const noexcept override { return now; }
    std::int64_t now = 0;
  };
  Clock clock_;
  omentum::test::FakeBus bus_;
  RecordingRenderer renderer_;
  runtime::FaultList faults_;
  std::unique_ptr<transport::Bus> own_ = bus_.opener()();
  TouchView view_{*own_, 2, renderer_, clock_, faults_};
  std::unique_ptr<transport::Bus> deform_ = bus_.opener()();
  std::unique_ptr<transport::Writer<msg::TouchingPairs>> writer_ = deform_->writer<msg::TouchingPairs>();
};

TEST_F(TouchViewTest, IsReadAndDrawnOnlyWhileItIsOn) {
  EXPECT_THAT(drawn(false), IsEmpty());
  EXPECT_FALSE(is_read());
  EXPECT_FALSE(view_.row().on);
  EXPECT_THAT(drawn(), IsEmpty());
  EXPECT_TRUE(is_read());
  bus_.post(moment(1, {touching(0, 0.02f)}));
  EXPECT_THAT(drawn(), SizeIs(1));
  EXPECT_THAT(drawn(false), IsEmpty());
  EXPECT_FALSE(is_read());
  EXPECT_THAT(drawn(), IsEmpty()) << "what was told before is of another moment";
}

TEST_F(TouchViewTest, APairIsMarkedBetweenItsPartsInItsForcesColour) {
  drawn();
  bus_.post(moment(1, {touching(0, 0.02f), touching(0.1f, 0.03f), touching(0.2f, 0.5f)}));
  const std::vector<DrawItem> items = drawn();
  ASSERT_THAT(items, SizeIs(2)) << "one mesh of each band";
  EXPECT_EQ(items[0].look, Look::kSignal);
  EXPECT_EQ(items[0].material.colour, touch_colours()[touch_band(0.02f)]);
  EXPECT_EQ(items[1].material.colour, touch_colours()[touch_band(0.5f)]);
  EXPECT_EQ(renderer_.mesh_of(items[0]).triangles.size(), 2 * renderer_.mesh_of(items[1]).triangles.size());
  for (const Vertex& vertex : renderer_.mesh_of(items[1]).vertices) {
    EXPECT_GE(vertex.position.x(), 0.2f) << "not beyond the parts' middles";
    EXPECT_LE(vertex.position.x(), 0.218f);
    EXPECT_LT(vertex.position.tail<2>().norm(), 0.0021f);
  }
  EXPECT_EQ(view_.row().count, 3U);
  EXPECT_FLOAT_EQ(static_cast<float>(view_.row().hardest_n), 0.5f);
}

TEST_F(TouchViewTest, ItsTrianglesFaceOut) {
  drawn();
  bus_.post(moment(1, {touching(0, 1)}));
  const MeshData& mesh = renderer_.mesh_of(drawn().at(0));
  for (const MeshTriangle& t : mesh.triangles) {
    const Vertex &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    EXPECT_GT((b.position - a.position).cross(c.position - a.position).dot(a.normal + b.normal + c.normal),
              0);
  }
}

TEST_F(TouchViewTest, TheNextMomentTakesItsMeshesAndWhatIsOldIsGone) {
  drawn();
  bus_.post(moment(1, {touching(0, 0.02f)}));
  const MeshId mesh = drawn().at(0).mesh;
  bus_.post(moment(2, {touching(0, 0.02f), touching(1, 0.02f)}));
  EXPECT_EQ(drawn().at(0).mesh, mesh);
  EXPECT_EQ(view_.row().count, 2U);
  bus_.post(moment(3, {}));
  EXPECT_THAT(drawn(), IsEmpty());
  EXPECT_TRUE(view_.row().known) << "nobody touches";
  bus_.post(moment(4, {touching(0, 0.02f)}));
  drawn();
  clock_.now += TouchView::kGone_ns + 1;
  EXPECT_THAT(drawn(), IsEmpty());
  EXPECT_FALSE(view_.row().known);
}

TEST_F(TouchViewTest, AMomentWaitsForItsBlocksUntilTheNextOneBegins) {
  drawn();
  msg::TouchingPairs part = moment(1, {touching(0, 0.02f)});
  part.block_count = 2;
  bus_.post(part);
  EXPECT_THAT(drawn(), IsEmpty());
  part.block = 1;
  bus_.post(part);
  bus_.post(part);  // twice is once
  EXPECT_EQ(renderer_.mesh_of(drawn().at(0)).triangles.size(), 2U * 16U);
  part.seq = 2;
  bus_.post(part);
  part.seq = 3;
  bus_.post(part);
  EXPECT_EQ(renderer_.mesh_of(drawn().at(0)).triangles.size(), 16U) << "a block of the second was lost";
}

TEST_F(TouchViewTest, WhatNoSceneCanHaveIsAFaultAndNotDrawn) {
  drawn();
  msg::TouchingPair foreign = touching(0, 1), far = foreign, pull = foreign, flat = foreign,
                    endless = foreign;
  foreign.organ_other = 2;
  far.one_y = 1e6f;
  pull.push = -1;
  flat.radius_one = 0;
  endless.other_z = std::numeric_limits<float>::quiet_NaN();
  for (const msg::TouchingPair& pair : {foreign, far, pull, flat, endless}) bus_.post(moment(1, {pair}));
  msg::TouchingPairs beyond = moment(1, {});
  beyond.block = 1;
  bus_.post(beyond);
  EXPECT_THAT(drawn(), IsEmpty());
  EXPECT_FALSE(faults_.lines().empty());
}

}  // namespace
}  // namespace omentum::render
