// What is drawn of an organ that was cut, on a renderer that only remembers.
#include "box_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace omentum::render {
namespace {

using test::box_organ;
using test::Cutter;
using test::in_slit;
using test::kBoxSide_m;

constexpr int kCells = 4;
constexpr float kFloat = 1e-6f;

/// One box, drawn.
struct Stage {
  explicit Stage(const OrganShape& organ = box_organ(kCells)) : shape(organ), view(scene, {shape}, renderer) {
    choices.orbit = view.first_camera();
  }
  bool show(const Cutter& cutter) { return view.show(0, cutter.removed(), cutter.rest()); }
  const DrawItem* item(Look look) {
    frame = view.frame(choices, std::vector<ToolNow>(1), 0);
    const auto found = std::find_if(frame.items.begin(), frame.items.end(),
                                    [&](const DrawItem& item) { return item.look == look; });
    return found == frame.items.end() ? nullptr : &*found;
  }
  const MeshData& mesh(Look look) { return renderer.mesh_of(*item(look)); }

  OrganShape shape;
  scene::Scene scene = one_probe();
  RecordingRenderer renderer;
  SceneView view;
  ViewChoices choices;
  Frame frame;

 private:
  static scene::Scene one_probe() {
    scene::Scene scene;
    scene.tools.emplace_back();
    return scene;
  }
};

bool is_point(const MeshTriangle& t) {
  return t[0] == t[1] && t[1] == t[2];
}

// Edges of all meshes by the places of their ends: of a closed surface each runs once in either direction.
class Edges {
 public:
  void add(const MeshData& mesh) {
    for (const MeshTriangle& t : mesh.triangles) {
      if (is_point(t)) continue;
      for (int c = 0; c < 3; ++c)
        ++count_[{place(mesh.vertices[t[c]].position), place(mesh.vertices[t[(c + 1) % 3]].position)}];
    }
  }
  int open() const {
    int open = 0;
    for (const auto& [edge, count] : count_) {
      const auto back = count_.find({edge.second, edge.first});
      open += back == count_.end() || back->second != count;
    }
    return open;
  }

 private:
  using Place = std::array<long, 3>;
  static Place place(const Vec3f& p) {
    return {std::lround(p.x() / kFloat), std::lround(p.y() / kFloat), std::lround(p.z() / kFloat)};
  }
  std::map<std::pair<Place, Place>, int> count_;
};

std::vector<std::byte> bytes_of(const MeshData& mesh) {
  const auto vertices = std::as_bytes(std::span(mesh.vertices)),
             triangles = std::as_bytes(std::span(mesh.triangles));
  std::vector<std::byte> all(vertices.begin(), vertices.end());
  all.insert(all.end(), triangles.begin(), triangles.end());
  return all;
}

TEST(OrganCut, ShapeIsThatOfTheBooksAndNumbersNodesAsStatesDo) {
  const OrganShape box = box_organ(kCells);
  Cutter cutter(box);
  cutter.cut(in_slit);
  OrganCut cut(*box.mesh, box.surface);
  cut.set(cutter.removed());
  const CutShape shape = cut.shape();
  EXPECT_TRUE(std::equal(box.surface.node.begin(), box.surface.node.end(), shape.node.begin()));
  EXPECT_TRUE(std::is_sorted(shape.node.begin() + box.surface.node_count(), shape.node.end()));
  EXPECT_GT(shape.bared.size(), 0u);
  const auto gone = static_cast<std::size_t>(std::count(shape.gone.begin(), shape.gone.end(), 1));
  EXPECT_EQ(shape.gone.size() - gone + shape.bared.size(), cutter.books().faces().size());
}

TEST(OrganCut, HeatIsSeenWhereItTookTissueOnly) {
  const OrganShape box = box_organ(kCells);
  Cutter cutter(box);
  cutter.cut([](const auto& p) { return in_slit(p) && p.y() < 0.5 * kBoxSide_m; }, true);
  cutter.cut([](const auto& p) { return in_slit(p) && p.y() > 0.5 * kBoxSide_m; }, false);
  OrganCut cut(*box.mesh, box.surface);
  cut.set(cutter.removed());
  const CutShape shape = cut.shape();
  int burnt = 0;
  for (std::size_t s = 0; s < shape.node.size(); ++s) {
    if (shape.burnt[s] == 0) continue;
    ++burnt;
    EXPECT_EQ(shape.burnt[s], 1);
    EXPECT_LE(shape.rest[s].y(), 0.5 * kBoxSide_m + kFloat);
    EXPECT_GE(shape.rest[s].z(), 0.5 * kBoxSide_m - kFloat);
  }
  EXPECT_GT(burnt, 0);
}

TEST(CutOrgan, SkinAndInsideAreClosedTogetherAndApartInLight) {
  Stage stage;
  Cutter cutter(stage.shape);
  cutter.cut(in_slit);
  ASSERT_TRUE(stage.show(cutter));
  const MeshData skin = stage.mesh(Look::kCut), inside = stage.mesh(Look::kBared);
  Edges edges;
  edges.add(skin);
  edges.add(inside);
  EXPECT_EQ(edges.open(), 0);
  // along the rim two vertices lie in one place, and light breaks between them
  std::map<std::array<float, 3>, Vec3f> skin_normal;
  for (const MeshTriangle& t : skin.triangles)
    for (const std::uint32_t v : t)
      if (!is_point(t)) {
        const Vec3f& p = skin.vertices[v].position;
        skin_normal[{p.x(), p.y(), p.z()}] = skin.vertices[v].normal;
      }
  int broken = 0;
  for (const Vertex& v : inside.vertices) {
    const auto same = skin_normal.find({v.position.x(), v.position.y(), v.position.z()});
    broken += same != skin_normal.end() && same->second.dot(v.normal) < 0.7f;
  }
  EXPECT_GT(broken, kCells);
}

TEST(CutOrgan, SkinStaysAsItWasWhereNothingWasCut) {
  constexpr double kCell_m = kBoxSide_m / 8;
  Stage stage(box_organ(8));
  const MeshData before = stage.mesh(Look::kTissue);
  Cutter cutter(stage.shape);
  cutter.cut(in_slit);
  ASSERT_TRUE(stage.show(cutter));
  const MeshData& after = stage.mesh(Look::kCut);
  ASSERT_EQ(after.vertices.size(), before.vertices.size());
  int far = 0;
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    EXPECT_EQ(after.vertices[i].rest, before.vertices[i].rest) << "the pattern sticks to the tissue";
    // the slit is two cells wide; normals of the cell beside it turn with its rim
    if (std::abs(before.vertices[i].rest.x() - kBoxSide_m / 2) < 3 * kCell_m - 1e-6) continue;
    ++far;
    EXPECT_EQ(after.vertices[i].position, before.vertices[i].position);
    EXPECT_EQ(after.vertices[i].normal, before.vertices[i].normal);
    EXPECT_EQ(after.vertices[i].charring, 0);
  }
  EXPECT_GT(far, 100);
}

TEST(CutOrgan, OnlyTrianglesThatChangedAreSent) {
  Stage stage;
  const std::size_t all = stage.mesh(Look::kTissue).triangles.size();
  const std::size_t per_face = all / stage.shape.surface.triangles.size();
  Cutter cutter(stage.shape);
  const geometry::TetId behind = stage.shape.surface.tetrahedron[0];
  cutter.remove(std::array{behind});
  const auto bared_of = static_cast<std::size_t>(
      std::count(stage.shape.surface.tetrahedron.begin(), stage.shape.surface.tetrahedron.end(), behind));
  ASSERT_TRUE(stage.show(cutter));
  EXPECT_EQ(stage.renderer.triangles_sent, bared_of * per_face);
  ASSERT_TRUE(stage.show(cutter));
  EXPECT_EQ(stage.renderer.triangles_sent, bared_of * per_face) << "the same topology again";
}

TEST(CutOrgan, WholeAgainIsDrawnAsIfNothingHadBeen) {
  Stage stage;
  Cutter cutter(stage.shape);
  ASSERT_TRUE(stage.show(cutter));
  const std::vector<std::byte> before = bytes_of(stage.mesh(Look::kTissue));
  EXPECT_EQ(stage.item(Look::kBared), nullptr);
  const std::vector<float> whole = cutter.rest();
  cutter.cut(in_slit, true);
  ASSERT_TRUE(stage.show(cutter));
  EXPECT_NE(stage.item(Look::kBared), nullptr);
  EXPECT_EQ(stage.view.removed_count(0), cutter.books().removed_count());
  ASSERT_TRUE(stage.view.show(0, RemovedSet{{0, 0}, {}}, whole));
  EXPECT_EQ(stage.item(Look::kBared), nullptr);
  EXPECT_EQ(bytes_of(stage.mesh(Look::kTissue)), before);
  EXPECT_EQ(stage.view.removed_count(0), 0);
}

TEST(CutOrgan, WhoJoinsAfterThreeHundredCutsDrawsWhatTheFirstDraws) {
  Stage first, late;
  Cutter cutter(first.shape);
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> any(
      0, static_cast<std::int32_t>(first.shape.mesh->tetrahedra.size()) - 1);
  for (int k = 0; k < 300 && cutter.books().removed_count() < 250; ++k) {
    cutter.remove(std::array{geometry::TetId(any(random))}, k % 2 == 0);
    ASSERT_TRUE(first.show(cutter));
  }
  ASSERT_TRUE(late.show(cutter));
  EXPECT_EQ(bytes_of(first.mesh(Look::kCut)), bytes_of(late.mesh(Look::kCut)));
  EXPECT_EQ(bytes_of(first.mesh(Look::kBared)), bytes_of(late.mesh(Look::kBared)));
  EXPECT_EQ(first.view.removed_count(0), late.view.removed_count(0));
}

TEST(CutOrgan, ALonePieceKeepsItsSizeAndItsPlace) {
  Stage stage;
  Cutter cutter(stage.shape);
  const auto inside = static_cast<std::size_t>(
      std::find_if(stage.shape.mesh->tetrahedra.begin(), stage.shape.mesh->tetrahedra.end(),
                   [&](const geometry::Tetrahedron& t) {
                     return std::none_of(t.begin(), t.end(), [&](geometry::NodeId n) {
                       return stage.shape.surface.of_node[static_cast<std::size_t>(n)].valid();
                     });
                   }) -
      stage.shape.mesh->tetrahedra.begin());
  ASSERT_LT(inside, stage.shape.mesh->tetrahedra.size());
  std::vector<geometry::TetId> others;
  Eigen::AlignedBox3f piece, drawn;
  for (std::size_t t = 0; t < stage.shape.mesh->tetrahedra.size(); ++t)
    if (t != inside) others.emplace_back(t);
  for (const geometry::NodeId n : stage.shape.mesh->tetrahedra[inside])
    piece.extend(stage.shape.mesh->positions[n].cast<float>());
  cutter.remove(others);
  ASSERT_TRUE(stage.show(cutter));
  for (const Vertex& v : stage.mesh(Look::kBared).vertices) drawn.extend(v.position);
  EXPECT_GT(drawn.sizes().minCoeff(), 0.35f * piece.sizes().minCoeff());
  EXPECT_LT((drawn.center() - piece.center()).norm(), 0.35f * piece.sizes().norm());
}

TEST(CutOrgan, EverythingMayBeCutAway) {
  Stage stage;
  Cutter cutter(stage.shape);
  cutter.cut([](const auto&) { return true; });
  ASSERT_TRUE(stage.show(cutter));
  for (const MeshTriangle& t : stage.mesh(Look::kCut).triangles) EXPECT_TRUE(is_point(t));
  EXPECT_TRUE(stage.mesh(Look::kBared).triangles.empty());
}

TEST(CutOrgan, TheGroundIsShadedByWhatIsLeftWhereItLies) {
  Stage stage;
  Cutter cutter(stage.shape);
  const std::vector<float> at_rest = cutter.rest();
  const auto darkest = [&] {
    stage.view.shade_ground();
    return *std::ranges::min_element(stage.mesh(Look::kGround).vertices, {}, &Vertex::openness);
  };
  const Vertex whole = darkest();
  ASSERT_LT(whole.openness, 0.5f);
  cutter.cut([](const geometry::Vec3& p) { return p.x() < 0.3 * kBoxSide_m; });
  const geometry::Vec3 fallen(4 * kBoxSide_m, 0, 0);
  ASSERT_TRUE(stage.view.show(0, cutter.removed(), cutter.state([&](const auto&) { return fallen; })));
  EXPECT_NEAR(darkest().position.x() - whole.position.x(), fallen.x(), kBoxSide_m);
  EXPECT_LT(darkest().openness, 0.9f) << "rings are farther apart out there";
  cutter.cut([](const geometry::Vec3&) { return true; });
  ASSERT_TRUE(stage.show(cutter));
  EXPECT_GT(darkest().openness, 0.99f) << "nothing is left";
  ASSERT_TRUE(stage.view.show(0, RemovedSet{}, at_rest));
  EXPECT_NEAR(darkest().openness, whole.openness, 0.05) << "a reset brings it back";
}

TEST(CutOrgan, AStateOfAnotherSetThanItSaysIsNotDrawn) {
  Stage stage;
  Cutter cutter(stage.shape);
  const std::vector<float> whole = cutter.rest();
  cutter.cut(in_slit);
  const std::vector<std::byte> before = bytes_of(stage.mesh(Look::kTissue));
  EXPECT_FALSE(stage.view.show(0, cutter.removed(), whole)) << "too few nodes";
  EXPECT_FALSE(stage.view.show(0, RemovedSet{}, cutter.rest())) << "too many";
  EXPECT_EQ(bytes_of(stage.mesh(Look::kTissue)), before);
  EXPECT_EQ(stage.renderer.updates, 0);
}

TEST(CutOrgan, ContactsWithWhatLiesBareAreFoundAndWithWhatIsGoneAreNot) {
  Stage stage;
  Cutter cutter(stage.shape);
  cutter.cut(in_slit);
  ASSERT_TRUE(stage.show(cutter));
  const PressedSurface& surface = *stage.view.surface(0);
  const auto nodes = cutter.books().surface_nodes();
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const auto file_node = static_cast<std::uint32_t>(stage.shape.mesh->file_node[nodes[s]]);
    EXPECT_EQ(surface.node(file_node), geometry::SurfaceId(s));
    EXPECT_EQ(surface.skin.has(geometry::SurfaceId(s)), cutter.books().uses(nodes[s]) > 0);
  }
}

}  // namespace
}  // namespace omentum::render
