// Drops of blood on what was parted without heat.
#include "render_node/bleeding.h"

#include "box_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace omentum::render {
namespace {

using test::Cutter;
using test::in_slit;
using test::kBoxSide_m;

/// A box that is drawn and may be cut.
struct Wounded {
  explicit Wounded(const OrganShape& organ) : view({}, std::vector{organ}, renderer) {}
  bool show(const Cutter& cutter) { return view.show(0, cutter.removed(), cutter.rest()); }
  void wait(double seconds) {
    view.live(0, {}, seconds);
    view.refresh(0);
  }
  const MeshData* blood() {
    ViewChoices choices;
    choices.orbit = view.first_camera();
    const Frame frame = view.frame(choices, {}, 0);
    const auto found = std::ranges::find(frame.items, Look::kBlood, &DrawItem::look);
    return found == frame.items.end() ? nullptr : &renderer.mesh_of(*found);
  }
  RecordingRenderer renderer;
  SceneView view;
};

bool same(const MeshData& a, const MeshData& b) {
  return a.triangles == b.triangles && a.vertices.size() == b.vertices.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)) == 0;
}

std::size_t vertices_off_origin(const MeshData& mesh) {
  return static_cast<std::size_t>(
      std::ranges::count_if(mesh.vertices, [](const Vertex& v) { return v.position != Vec3f::Zero(); }));
}

class BleedingOrgan : public testing::Test {
 protected:
  const OrganShape box_ = test::box_organ(6);
  Wounded organ_{box_};
  Cutter cutter_{box_};
};

TEST_F(BleedingOrgan, AWholeOneDoesNotBleedAndHeatClosesVessels) {
  ASSERT_TRUE(organ_.show(cutter_));
  EXPECT_EQ(organ_.blood(), nullptr);
  cutter_.cut(in_slit, true);
  ASSERT_TRUE(organ_.show(cutter_));
  organ_.wait(1);
  EXPECT_EQ(organ_.blood(), nullptr);
}

TEST_F(BleedingOrgan, AColdCutBleedsAndItsDropsRunDownAndStay) {
  cutter_.cut(in_slit);
  ASSERT_TRUE(organ_.show(cutter_));
  organ_.wait(0.2);
  ASSERT_NE(organ_.blood(), nullptr);
  const auto mean_height = [&] {
    float sum = 0;
    for (const Vertex& v : organ_.blood()->vertices) sum += v.position.z();
    return sum / static_cast<float>(vertices_off_origin(*organ_.blood()));
  };
  const float first = mean_height();
  organ_.wait(1);
  const float later = mean_height();
  EXPECT_LT(later, first - 0.0005f);
  organ_.wait(2);
  const int updates = organ_.renderer.updates;
  EXPECT_LT(mean_height(), later);
  organ_.wait(2);
  EXPECT_EQ(organ_.renderer.updates, updates) << "they stay, and nothing is sent any more";
}

TEST_F(BleedingOrgan, DropsAndTheirTrailsFaceOutwards) {
  cutter_.cut(in_slit);
  ASSERT_TRUE(organ_.show(cutter_));
  organ_.wait(Bleeding::kRun_s);
  const MeshData& blood = *organ_.blood();
  int faces = 0, inwards = 0;
  for (const auto& [a, b, c] : blood.triangles) {
    const Vertex &p = blood.vertices[a], &q = blood.vertices[b], &r = blood.vertices[c];
    const Vec3f normal = (q.position - p.position).cross(r.position - p.position);
    if (normal.norm() < 1e-9f) continue;
    ++faces;
    inwards += normal.dot(p.normal + q.normal + r.normal) < 0;
  }
  EXPECT_GT(faces, 200);
  EXPECT_LT(inwards, faces / 20) << "where a trail turns sharply it may fold";
}

TEST_F(BleedingOrgan, WhoJoinsLateSeesTheSameDropsWhenTheyHaveRun) {
  const auto half = [](const geometry::Vec3& p) { return in_slit(p) && p.y() < kBoxSide_m / 2; };
  cutter_.cut(half);
  ASSERT_TRUE(organ_.show(cutter_));
  organ_.wait(Bleeding::kRun_s);
  cutter_.cut(in_slit);
  ASSERT_TRUE(organ_.show(cutter_));
  Wounded late(box_);
  ASSERT_TRUE(late.show(cutter_));
  for (Wounded* one : {&organ_, &late}) one->wait(Bleeding::kRun_s);
  ASSERT_NE(late.blood(), nullptr);
  EXPECT_TRUE(same(*organ_.blood(), *late.blood()));
}

TEST_F(BleedingOrgan, WholeAgainHasNoDropsLeft) {
  cutter_.cut(in_slit);
  ASSERT_TRUE(organ_.show(cutter_));
  ASSERT_TRUE(organ_.view.show(0, RemovedSet{}, Cutter(box_).rest()));
  EXPECT_EQ(organ_.blood(), nullptr);
}

TEST_F(BleedingOrgan, DropsLieOnTheOrganWhereverItGoes) {
  cutter_.cut(in_slit);
  const geometry::Vec3 aside(0.03, -0.01, 0.02);
  ASSERT_TRUE(organ_.show(cutter_));
  organ_.wait(Bleeding::kRun_s);
  const MeshData before = *organ_.blood();
  ASSERT_TRUE(organ_.view.show(0, cutter_.removed(), cutter_.state([&](const auto&) { return aside; })));
  const MeshData& after = *organ_.blood();
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    if (before.vertices[i].position == Vec3f::Zero()) continue;
    const Vec3f way = after.vertices[i].position - before.vertices[i].position;
    EXPECT_LT((way - aside.cast<float>()).norm(), 1e-5f);
    ++moved;
  }
  EXPECT_GT(moved, 50u);
}

TEST_F(BleedingOrgan, DropsAreBoundedAndACutThatGoesOnLeavesThem) {
  Bleeding bleeding;
  const auto drops_after = [&] {
    OrganCut books(*box_.mesh, box_.surface);
    books.set(cutter_.removed());
    const CutShape shape = books.shape();
    std::vector<Vec3f> rest;
    for (const geometry::Vec3& p : shape.rest) rest.push_back(p.cast<float>());
    bleeding.cut(shape, shape.bared, 0, rest);
    return bleeding.drop_count();
  };
  std::size_t last = 0;
  for (const double reach : {0.2, 0.5, 0.8, 1.0}) {
    cutter_.cut([&](const geometry::Vec3& p) { return in_slit(p) && p.y() < reach * kBoxSide_m; });
    const std::size_t now = drops_after();
    EXPECT_GE(now + 2, last) << "a face or two of the wound's end are cut away themselves";
    last = now;
  }
  cutter_.cut([](const geometry::Vec3& p) { return std::fmod(p.x(), 0.035) < 0.017; });
  EXPECT_EQ(drops_after(), Bleeding::kMostDrops) << "of some hundreds";
}

/// Two triangles that slope like a roof of slope 1 towards +x, and then lie level.
struct Ramp {
  std::vector<Vec3f> places{{0, 0, 0.01f},     {0, 0.01f, 0.01f}, {0.01f, 0, 0},
                            {0.01f, 0.01f, 0}, {0.02f, 0, 0},     {0.02f, 0.01f, 0}};
  std::vector<geometry::Triangle> triangles;
  Ramp() {
    for (const auto& [a, b, c] : {std::array{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}})
      triangles.push_back({geometry::SurfaceId(a), geometry::SurfaceId(b), geometry::SurfaceId(c)});
  }
};

TEST(Downhill, RunsAlongTheSlopeAsFarAsItMay) {
  const Ramp ramp;
  const Downhill downhill(ramp.triangles, ramp.places);
  const auto way = downhill.way(1, {0.5f, 0.1f, 0.4f}, 0.004f, 12);
  const Vec3f from = at(way.front(), ramp.places), to = at(way.back(), ramp.places);
  EXPECT_NEAR((to - from).norm(), 0.004f, 1e-5f);
  EXPECT_NEAR(to.y(), from.y(), 1e-6f);
  EXPECT_NEAR(to.x() - from.x(), from.z() - to.z(), 1e-6f) << "on the slope";
}

TEST(Downhill, CrossesEdgesAndStaysWhereItIsLevel) {
  const Ramp ramp;
  const Downhill downhill(ramp.triangles, ramp.places);
  const auto way = downhill.way(1, {0.5f, 0.1f, 0.4f}, 1, 12);
  EXPECT_GE(way.size(), 3u);
  const Vec3f to = at(way.back(), ramp.places);
  EXPECT_NEAR(to.z(), 0, 1e-6f);
  EXPECT_NEAR(to.x(), 0.01f, 1e-6f);
  EXPECT_EQ(downhill.way(1, {0.5f, 0.1f, 0.4f}, 1, 2).size(), 2u) << "no more points than asked for";
}

}  // namespace
}  // namespace omentum::render
