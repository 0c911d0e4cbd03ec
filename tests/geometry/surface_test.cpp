#include "geometry/surface.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace omentum::geometry {
namespace {

class SurfaceTest : public testing::Test {
 protected:
  SurfaceTest() : mesh_(test::make_box_mesh(7, 5, 6, {0.7, 0.5, 0.6})) {
    for (const Vec3& p : mesh_.positions) pinned_.push_back(p.x() < 0.15);
    surface_ = extract_surface(mesh_, pinned_);
    positions_ = surface_positions(mesh_, surface_);
  }
  TetraMesh mesh_;
  std::vector<bool> pinned_;
  Surface surface_;
  std::vector<Vec3> positions_;
};

TEST_F(SurfaceTest, EveryEdgeIsUsedOnceInEachDirection) {
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : surface_.triangles) {
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((uses.count({edge.second, edge.first})), 1u);
  }
  EXPECT_EQ(
      surface_.node_count() - static_cast<int>(uses.size() / 2) + static_cast<int>(surface_.triangles.size()),
      2);
}

TEST_F(SurfaceTest, NormalsPointOutwardsSoThatTheSurfaceEnclosesTheMeshVolume) {
  double volume = 0;
  for (const Triangle& t : surface_.triangles) {
    volume += signed_volume(Vec3::Zero(), positions_[t[0]], positions_[t[1]], positions_[t[2]]);
  }
  EXPECT_NEAR(volume, 0.7 * 0.5 * 0.6, 1e-14);
}

TEST_F(SurfaceTest, TheTetrahedronBehindATriangleHoldsItsNodes) {
  for (std::size_t f = 0; f < surface_.triangles.size(); ++f) {
    const Tetrahedron& behind = mesh_.tetrahedra[surface_.tetrahedron[f]];
    for (const SurfaceId s : surface_.triangles[f]) {
      EXPECT_NE(std::find(behind.begin(), behind.end(), surface_.node[s]), behind.end());
    }
  }
}

TEST_F(SurfaceTest, NumberingOfNodesIsABijectionOntoBoundaryNodes) {
  int on_boundary = 0;
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n) {
    const Vec3 p = mesh_.positions[n], q = Vec3(0.7, 0.5, 0.6) - p;
    const bool boundary = p.minCoeff() < 1e-9 || q.minCoeff() < 1e-9;
    on_boundary += boundary;
    EXPECT_EQ(surface_.of_node[n].valid(), boundary);
    if (boundary) {
      EXPECT_EQ(surface_.node[surface_.of_node[n]], static_cast<int>(n));
    }
  }
  EXPECT_EQ(surface_.node_count(), on_boundary);
}

TEST_F(SurfaceTest, PinnedNodesComeLast) {
  for (std::int32_t s = 0; s < surface_.node_count(); ++s) {
    EXPECT_EQ(pinned_[surface_.node[s]], s >= surface_.mobile_count);
  }
  EXPECT_EQ(extract_surface(mesh_, {}).mobile_count, surface_.node_count());
}

TEST_F(SurfaceTest, FansHoldExactlyTheTrianglesAroundANode) {
  std::size_t total = 0;
  for (std::int32_t s = 0; s < surface_.node_count(); ++s) {
    for (const TriangleId f : surface_.triangles_of(SurfaceId(s))) {
      const Triangle& t = surface_.triangles[f];
      EXPECT_NE(std::find(t.begin(), t.end(), SurfaceId(s)), t.end());
      ++total;
    }
  }
  EXPECT_EQ(total, 3 * surface_.triangles.size());
}

TEST_F(SurfaceTest, ClustersAreCompact) {
  // 16 nodes of a grid with spacing 0.1 m are at best a square of 4 x 4 (diagonal 0.42 m); patches that bend
  // around the box's edges and corners or are cut to fit may be a little longer, runs of 16 in the mesh's own
  // order are 0.66 m
  constexpr double kCompact = 0.55;
  double sum = 0;
  int clusters = 0;
  for (std::int32_t first = 0; first + kClusterSize <= surface_.mobile_count;
       first += kClusterSize, ++clusters) {
    Vec3 low = positions_[first], high = low;
    for (std::int32_t s = first; s < first + kClusterSize; ++s) {
      low = low.cwiseMin(positions_[s]);
      high = high.cwiseMax(positions_[s]);
    }
    sum += (high - low).norm();
  }
  EXPECT_LT(sum / clusters, kCompact);
}

TEST_F(SurfaceTest, TheSameMeshGivesTheSameNumbering) {
  const Surface again = extract_surface(mesh_, pinned_);
  EXPECT_EQ(again.node, surface_.node);
  EXPECT_EQ(again.triangles, surface_.triangles);
}

// A box without symmetry: a face's nodes point straight out, those of edges and corners between their faces.
TEST_F(SurfaceTest, NormalsAreUnitAndPointOut) {
  const Vec3 size(0.03, 0.05, 0.02);
  const TetraMesh box = test::make_box_mesh(3, 5, 4, size);
  const Surface surface = extract_surface(box, {});
  const std::vector<Vec3> x = surface_positions(box, surface), n = surface_normals(surface, x);
  ASSERT_EQ(n.size(), x.size());
  for (std::size_t s = 0; s < x.size(); ++s) {
    EXPECT_NEAR(n[s].norm(), 1, 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      const bool low = x[s][axis]<1e-9, high = x[s][axis]> size[axis] - 1e-9;
      if (low) {
        EXPECT_LT(n[s][axis], -0.1);
      } else if (high) {
        EXPECT_GT(n[s][axis], 0.1);
      } else {
        EXPECT_NEAR(n[s][axis], 0, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace omentum::geometry
