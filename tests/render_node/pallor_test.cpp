// Tissue pales under pressure: what is spread over what, how far, and how fast.
#include "render_node/pallor.h"
#include "ball_organ.h"
#include "gut_organ.h"
#include "recording_renderer.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_drawing.h"

#include "geometry/gut_skin.h"

#include <gtest/gtest.h>

#include <numeric>

namespace omentum::render {
namespace {

constexpr double kPressedBall_m = 0.05;
constexpr float kFirmPress_n = 0.4f;

/// A level square of 10 cm with `cells` along each side, outward up.
MeshData square_of(int cells) {
  MeshData mesh;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      Vertex& vertex = mesh.vertices.emplace_back();
      vertex.position = vertex.rest = 0.1f / static_cast<float>(cells) * Vec3f(x, y, 0);
      vertex.normal = Vec3f::UnitZ();
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}
const Vec3f kSquareMiddle{0.05f, 0.05f, 0};

Press down(const Vec3f& place, float force_n) {
  return press_of(place, Vec3f::UnitZ(), Vec3f(0, 0, -force_n));
}

float palest(const MeshData& mesh) {
  float most = 0;
  for (const Vertex& vertex : mesh.vertices) most = std::max(most, vertex.pallor);
  return most;
}

/// What a second under these makes of a square.
float palest_after_a_second(std::span<const Press> presses) {
  MeshData mesh = square_of(40);
  Pallor pallor(mesh);
  pallor.advance(presses, 1, mesh.vertices);
  return palest(mesh);
}

TEST(ContactPressure, CarriesTheWholeForceHoweverFineTheMesh) {
  for (const int cells : {3, 10, 47}) {
    const MeshData mesh = square_of(cells);
    ContactPressure pressure(mesh);
    const std::vector<Press> presses{down({0.031f, 0.047f, 0}, 0.3f), down({0.08f, 0.02f, 0}, 0.5f)};
    const auto p = pressure.under(presses, mesh.vertices);
    double sum_n = 0;
    for (std::size_t v = 0; v < p.size(); ++v) sum_n += static_cast<double>(p[v] * pressure.area_m2(v));
    EXPECT_NEAR(sum_n, 0.8, 1e-5) << cells;
  }
}

TEST(ContactPressure, OnlyWhatFacesThePressTakesIt) {
  MeshData mesh = square_of(20);
  for (Vertex& vertex : mesh.vertices)
    if (vertex.position.x() > kSquareMiddle.x()) vertex.normal = -Vec3f::UnitZ();
  ContactPressure pressure(mesh);
  const auto p = pressure.under(std::vector{down(kSquareMiddle, 1)}, mesh.vertices);
  for (std::size_t v = 0; v < p.size(); ++v)
    if (mesh.vertices[v].normal.z() < 0) EXPECT_EQ(p[v], 0);
}

TEST(ContactPressure, PullsAndSlidesPressNothing) {
  EXPECT_EQ(press_of(Vec3f::Zero(), Vec3f::UnitZ(), Vec3f(0, 0, 2)).force_n, 0);
  EXPECT_EQ(press_of(Vec3f::Zero(), Vec3f::UnitZ(), Vec3f(2, 0, 0)).force_n, 0);
  EXPECT_FLOAT_EQ(press_of(Vec3f::Zero(), Vec3f::UnitZ(), Vec3f(1, 0, -2)).force_n, 2);
}

TEST(Pallor, WithoutForceThereIsNone) {
  MeshData mesh = square_of(10);
  Pallor pallor(mesh);
  pallor.advance({}, 0.1, mesh.vertices);
  EXPECT_EQ(palest(mesh), 0);
  EXPECT_FALSE(pallor.advance({}, 0.1, mesh.vertices)) << "and nothing to upload";
}

TEST(Pallor, RisesWithTheForceAndStaysBelowOne) {
  float last = 0;
  for (const float force_n : {0.05f, 0.1f, 0.2f, 0.5f, 2.0f}) {
    const float now = palest_after_a_second(std::vector{down(kSquareMiddle, force_n)});
    EXPECT_GT(now, last) << force_n;
    EXPECT_LE(now, 1) << force_n;
    last = now;
  }
}

TEST(Pallor, TheSameForceOverTwiceTheAreaPalesLess) {
  const std::vector<Press> at_one{down(kSquareMiddle, kFirmPress_n)};
  const std::vector<Press> at_two{down(kSquareMiddle - Vec3f(0.02f, 0, 0), kFirmPress_n / 2),
                                  down(kSquareMiddle + Vec3f(0.02f, 0, 0), kFirmPress_n / 2)};
  EXPECT_LT(palest_after_a_second(at_two), 0.8f * palest_after_a_second(at_one));
}

TEST(Pallor, ComesAtOnceAndLeavesInAboutASecond) {
  MeshData mesh = square_of(40);
  Pallor pallor(mesh);
  const std::vector<Press> press{down(kSquareMiddle, kFirmPress_n)};
  const float steady = palest_after_a_second(press);
  pallor.advance(press, 0.2, mesh.vertices);
  EXPECT_GT(palest(mesh), 0.9f * steady);
  pallor.advance({}, 0.2, mesh.vertices);
  EXPECT_GT(palest(mesh), 0.5f * steady);
  pallor.advance({}, 0.8, mesh.vertices);
  EXPECT_NEAR(palest(mesh), 0.1f * steady, 0.02f * steady);
  for (int k = 0; k < 3; ++k) pallor.advance({}, 1, mesh.vertices);
  EXPECT_EQ(palest(mesh), 0);
  EXPECT_FALSE(pallor.advance({}, 1, mesh.vertices));
}

TEST(Pallor, NoFrameRateShows) {
  const std::vector<Press> press{down(kSquareMiddle, kFirmPress_n)};
  MeshData slow = square_of(20), fast = slow;
  Pallor at_slow(slow), at_fast(fast);
  const auto run = [&](std::span<const Press> presses, double seconds) {
    at_slow.advance(presses, seconds, slow.vertices);
    for (int k = 0; k < 60; ++k) at_fast.advance(presses, seconds / 60, fast.vertices);
    for (std::size_t v = 0; v < slow.vertices.size(); ++v)
      EXPECT_NEAR(slow.vertices[v].pallor, fast.vertices[v].pallor, 1e-5);
  };
  run(press, 0.1);
  run({}, 0.3);
  run(press, 0.05);
}

/// Where an organ is pale, and how much.
struct Whitened {
  explicit Whitened(const MeshData& mesh) {
    for (const Vertex& vertex : mesh.vertices) {
      sum += vertex.pallor;
      middle += vertex.pallor * vertex.position;
    }
    if (sum > 0) middle /= sum;
  }
  float sum = 0;
  Vec3f middle = Vec3f::Zero();
};

TEST(PalingOrgan, PalesAroundThePressedNodeAndIsSentWithoutAState) {
  const OrganShape shape = test::ball_organ(kPressedBall_m, 4);
  const scene::Scene scene = test::scene_with({"probe"});
  RecordingRenderer renderer;
  SceneView view(scene, std::vector{shape}, renderer);
  constexpr std::uint32_t kTop = 4;
  view.refresh(0);
  EXPECT_EQ(renderer.updates, 0) << "nothing new";
  view.live(0, std::vector<NodeForce>{{kTop + test::kFirstFileNode, {0, 0, -1}}, {999'999, {1, 1, 1}}}, 0.5);
  view.refresh(0);
  EXPECT_EQ(renderer.updates, 1);
  const Whitened seen(renderer.meshes.front());
  EXPECT_GT(seen.sum, 1);
  EXPECT_LT((seen.middle - Vec3f(0, 0, kPressedBall_m)).norm(), 0.003f);
  view.refresh(0);
  EXPECT_EQ(renderer.updates, 1);
}

/// A gut that is pressed at nodes of what tools touch.
struct PressedGut {
  PressedGut() {
    skin.place(gut.positions, places);
    organs.push_back(make_tube_drawing(gut, tissue_material("gut")));
    drawing = organs.front().get();
    view = std::make_unique<SceneView>(scene, std::move(organs), renderer);
  }
  std::uint32_t on_sheet() const { return static_cast<std::uint32_t>(skin.node_count()) - 150; }
  NodeForce pressed(std::uint32_t node, float force_n = 1) const {
    const geometry::Vec3 inward =
        geometry::weighted(skin.node(geometry::NodeId(std::size_t{node})), gut.positions) - places[node];
    return {node, force_n * inward.normalized().cast<float>()};
  }
  /// The wall as a renderer would draw what it was sent.
  MeshData wall() const {
    return skinned_tube(renderer.tubes.front(), static_cast<float>(gut.tube_radius_m), make_tube_cylinder(2));
  }
  MeshData sheet() const { return *drawing->parts().front().mesh; }

  geometry::GutShape gut = test::gut_shape();
  geometry::GutSkin skin{gut};
  std::vector<geometry::Vec3> places{skin.node_count()};
  scene::Scene scene;
  RecordingRenderer renderer;
  std::vector<std::unique_ptr<OrganDrawing>> organs;
  OrganDrawing* drawing = nullptr;
  std::unique_ptr<SceneView> view;
};
constexpr std::uint32_t kOnTube = 403;

TEST(PalingOrgan, AGutsWallPalesWhereItIsPressedAndIsSentWithoutAState) {
  for (const std::uint32_t node : {kOnTube, kOnTube + 1, kOnTube + 40, kOnTube + 77}) {
    PressedGut pressed;
    EXPECT_EQ(Whitened(pressed.wall()).sum, 0);
    const int sent = pressed.renderer.updates;
    pressed.view->live(0, std::vector{pressed.pressed(node)}, 0.5);
    pressed.view->refresh(0);
    EXPECT_GT(pressed.renderer.updates, sent);
    const MeshData wall = pressed.wall();
    EXPECT_GT(palest(wall), 0.3f) << node;
    EXPECT_LT((Whitened(wall).middle - pressed.places[node].cast<float>()).norm(), 0.006f) << node;
  }
}

TEST(PalingOrgan, AGutsWallReddensAgain) {
  PressedGut pressed;
  pressed.view->live(0, std::vector{pressed.pressed(kOnTube)}, 0.5);
  for (int k = 0; k < 4; ++k) pressed.view->live(0, {}, 1);
  pressed.view->refresh(0);
  EXPECT_EQ(palest(pressed.wall()), 0);
  const int sent = pressed.renderer.updates;
  pressed.view->live(0, {}, 1);
  pressed.view->refresh(0);
  EXPECT_EQ(pressed.renderer.updates, sent) << "nothing new";
}

TEST(PalingOrgan, OfAGutsWallAndItsMesenteryOnlyThePressedOnePales) {
  PressedGut on_tube, on_sheet;
  on_tube.view->live(0, std::vector{on_tube.pressed(kOnTube)}, 0.5);
  on_sheet.view->live(0, std::vector{on_sheet.pressed(on_sheet.on_sheet())}, 0.5);
  on_sheet.view->refresh(0);
  EXPECT_EQ(Whitened(on_tube.sheet()).sum, 0);
  EXPECT_EQ(palest(on_sheet.wall()), 0);
  EXPECT_GT(Whitened(on_sheet.sheet()).sum, 0.5f);
}

}  // namespace
}  // namespace omentum::render
