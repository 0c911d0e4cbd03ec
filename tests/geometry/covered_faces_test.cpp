// What lies on a boundary hides it, and bares it when it goes.
#include "geometry/covered_faces.h"

#include "geometry/mesh_editor.h"
#include "geometry/tetra_faces.h"
#include "geometry/touching_faces.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <random>
#include <set>

namespace omentum::geometry {
namespace {

/// A fine box below x = 1, a coarse one above: two meshes in one, whose faces at x = 1 lie on each other.
class CoveredFacesTest : public testing::Test {
 protected:
  CoveredFacesTest() {
    coarse_ = test::make_box_mesh(2, 2, 2, {1, 1, 1});
    for (Vec3& p : coarse_.positions) p.x() += 1;
    first_coarse_ = static_cast<std::int32_t>(fine_.tetrahedra.size());
    mesh_ = fine_;
    const auto shift = static_cast<std::int32_t>(fine_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), coarse_.positions.begin(), coarse_.positions.end());
    for (Tetrahedron t : coarse_.tetrahedra) {
      for (NodeId& n : t) n = NodeId(static_cast<std::int32_t>(n) + shift);
      mesh_.tetrahedra.push_back(t);
    }
    const BoundedMesh fine{fine_, fine_surface_}, coarse{coarse_, coarse_surface_};
    const std::vector<TriangleId> faces = faces_on(fine, coarse, 1e-6);
    const auto behind = behind_of(fine, faces, coarse);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      covered_.push_back(covered(fine, faces[i], 0));
      for (const TetId t : behind[i]) covered_.back().by.push_back(whole(t));
    }
    for (const TriangleId f : faces_on(coarse, fine, 1e-6))
      covered_.push_back(covered(coarse, f, first_coarse_));
  }

  TetId whole(TetId of_coarse) const { return TetId(static_cast<std::int32_t>(of_coarse) + first_coarse_); }
  static CoveredFace covered(const BoundedMesh& of, TriangleId f, std::int32_t shift) {
    const TetId t = of.surface.tetrahedron[f];
    int corner = 0;
    while (of.mesh.positions[of.mesh.tetrahedra[t][static_cast<std::size_t>(corner)]].x() == 1) ++corner;
    return {TetId(static_cast<std::int32_t>(t) + shift), corner, {}};
  }
  // Of what is left, by definition: behind, nodes, whether bared.
  std::set<std::tuple<TetId, std::array<NodeId, 3>, bool>> expected(const MeshEditor& editor) const {
    const TetraLinks links(mesh_.tetrahedra, mesh_.positions.size());
    std::set<std::tuple<TetId, std::array<NodeId, 3>, bool>> faces;
    for (std::size_t i = 0; i < mesh_.tetrahedra.size(); ++i) {
      const TetId t(i);
      if (editor.is_removed(t)) continue;
      for (int corner = 0; corner < 4; ++corner) {
        const TetId across = links.across(t)[static_cast<std::size_t>(corner)];
        if (across.valid() && !editor.is_removed(across)) continue;
        bool bared = across.valid(), hidden = false;
        for (const CoveredFace& face : covered_) {
          if (face.behind != t || face.corner != corner) continue;
          bared = true;
          hidden = std::ranges::none_of(face.by, [&](TetId by) { return editor.is_removed(by); });
        }
        const auto& [j, k, l] = kFaceOpposite[static_cast<std::size_t>(corner)];
        const Tetrahedron& v = mesh_.tetrahedra[t];
        if (!hidden)
          faces.insert({t,
                        {v[static_cast<std::size_t>(j)], v[static_cast<std::size_t>(k)],
                         v[static_cast<std::size_t>(l)]},
                        bared});
      }
    }
    return faces;
  }
  static std::set<std::tuple<TetId, std::array<NodeId, 3>, bool>> found(const MeshEditor& editor) {
    std::set<std::tuple<TetId, std::array<NodeId, 3>, bool>> faces;
    for (const SurfaceFace& f : editor.faces()) faces.insert({f.behind, f.nodes, f.bared});
    EXPECT_EQ(faces.size(), editor.faces().size());
    return faces;
  }

  TetraMesh fine_ = test::make_box_mesh(3, 3, 3, {1, 1, 1}), coarse_, mesh_;
  Surface fine_surface_ = extract_surface(fine_, {});
  Surface coarse_surface_ = extract_surface(test::make_box_mesh(2, 2, 2, {1, 1, 1}), {});
  std::int32_t first_coarse_ = 0;
  std::vector<CoveredFace> covered_;
};

TEST_F(CoveredFacesTest, WhatTouchesIsFoundAndIsNoSurface) {
  EXPECT_EQ(covered_.size(), 18u + 8u);
  EXPECT_THAT(covered_.front().by, testing::Not(testing::IsEmpty()));
  const MeshEditor editor(mesh_, {.covered = covered_});
  EXPECT_EQ(editor.faces().size(), 5u * 18 + 5u * 8);
  EXPECT_EQ(found(editor), expected(editor));
  const Surface whole = extract_surface(mesh_, {}), open = without_covered(mesh_, whole, covered_);
  EXPECT_EQ(open.triangles.size(), editor.faces().size());
  EXPECT_EQ(open.node, whole.node);
  for (std::size_t s = 0; s < open.node.size(); ++s)
    for (const TriangleId f : open.triangles_of(SurfaceId(s)))
      EXPECT_THAT(open.triangles[f], testing::Contains(SurfaceId(s)));
}

TEST_F(CoveredFacesTest, HoweverCutsComeAndGoTheSurfaceIsThatOfWhatIsLeft) {
  MeshEditor editor(mesh_, {.covered = covered_});
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int32_t> any(first_coarse_,
                                                  static_cast<std::int32_t>(mesh_.tetrahedra.size()) - 1);
  std::vector<std::uint8_t> once;
  for (int i = 0; i < 40; ++i) {
    const TetId t(any(random));
    editor.remove(std::span(&t, 1));
    ASSERT_EQ(found(editor), expected(editor)) << i;
    if (i == 3) once.assign(editor.removed_bits().begin(), editor.removed_bits().end());
  }
  editor.set_removed(once);
  EXPECT_EQ(found(editor), expected(editor));
  editor.restore();
  EXPECT_EQ(found(editor), expected(editor));
}

TEST_F(CoveredFacesTest, MeshesThatOverlapSayHowDeep) {
  const Surface& surface = coarse_surface_;
  EXPECT_EQ(deepest_inside({coarse_, surface}, {fine_, fine_surface_}), 0);
  for (Vec3& p : coarse_.positions) p.x() -= 0.1;
  EXPECT_NEAR(deepest_inside({coarse_, surface}, {fine_, fine_surface_}), 0.1, 1e-9);
  EXPECT_TRUE(faces_on({coarse_, surface}, {fine_, fine_surface_}, 0.05).empty());
}

}  // namespace
}  // namespace omentum::geometry
