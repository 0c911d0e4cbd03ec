#include "physics/stiffness.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

const Material kMaterial{5000, 0.3, 1000};
constexpr double kSumRounding = 1e-12;  // relative: sums of a few dozen tensors

class StiffnessTest : public testing::Test {
 protected:
  const geometry::TetraMesh mesh = test::make_box_mesh(3, 2, 4, {0.03, 0.02, 0.05});
  const Stiffness K = assemble_stiffness(mesh, kMaterial);
};

TEST_F(StiffnessTest, HoldingForcesAreSumOfElementForces) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0, 1e-3);
  std::vector<Vec3> u(mesh.positions.size()), expected(mesh.positions.size(), Vec3::Zero());
  for (Vec3& v : u) v = Vec3::NullaryExpr([&] { return normal(generator); });
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const ElementTensors element = element_tensors(corners_of(mesh, geometry::TetId(t)), kMaterial);
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) expected[mesh.tetrahedra[t][j]] += element[j][k] * u[mesh.tetrahedra[t][k]];
    }
  }

  const std::vector<Vec3> forces = holding_forces(K, u);

  for (std::size_t n = 0; n < forces.size(); ++n) {
    EXPECT_LE((forces[n] - expected[n]).norm(), kSumRounding * kMaterial.young_pa * 1e-3) << n;
  }
}

TEST_F(StiffnessTest, BlocksAreSymmetricAcrossDiagonal) {
  for (std::int32_t n = 0; n < K.node_count(); ++n) {
    for (std::int32_t b = K.start[n]; b < K.start[n + 1]; ++b) {
      const std::int32_t k = K.neighbour[b];
      std::int32_t mirror = K.start[k];
      while (K.neighbour[mirror] != n) ++mirror;
      EXPECT_LE((K.block[b] - K.block[mirror].transpose()).norm(), kSumRounding * K.block[b].norm());
    }
  }
}

TEST_F(StiffnessTest, BodyForcesSumToWeight) {
  const Vec3 gravity(1, -2, -9.81);
  Vec3 total = Vec3::Zero();
  for (const Vec3& f : body_forces(mesh, kMaterial, gravity)) total += f;
  const Vec3 weight = kMaterial.density_kg_m3 * 0.03 * 0.02 * 0.05 * gravity;
  EXPECT_LE((total - weight).norm(), kSumRounding * weight.norm());
}

TEST_F(StiffnessTest, EachTetrahedronIsOfItsRegionsMaterial) {
  geometry::TetraMesh labelled = mesh;
  labelled.regions.assign(mesh.tetrahedra.size(), 4);
  labelled.regions.front() = -2;
  const Material stiff{50000, 0.1, 3000};
  const MaterialMap material{kMaterial, {{-2, stiff}, {9, Material{1, 0, 1}}}};
  const Stiffness mixed = assemble_stiffness(labelled, material);

  const ElementTensors own = element_tensors(corners_of(mesh, geometry::TetId(0)), stiff),
                       common = element_tensors(corners_of(mesh, geometry::TetId(0)), kMaterial);
  const auto& tet = mesh.tetrahedra[0];
  for (int j = 0; j < 4; ++j) {
    for (std::int32_t b = K.start[tet[j]]; b < K.start[tet[j] + 1]; ++b) {
      const auto corner = std::ranges::find(tet, K.neighbour[b]);
      Eigen::Matrix3d expected = K.block[b];
      if (corner != tet.end()) expected += own[j][corner - tet.begin()] - common[j][corner - tet.begin()];
      EXPECT_LE((mixed.block[b] - expected).norm(), kSumRounding * mixed.block[b].norm());
    }
  }
  Vec3 more = Vec3::Zero();
  const Vec3 gravity(0, 0, -10);
  for (const Vec3& f : body_forces(labelled, material, gravity)) more += f;
  for (const Vec3& f : body_forces(mesh, kMaterial, gravity)) more -= f;
  const Corners c = corners_of(mesh, geometry::TetId(0));
  EXPECT_NEAR(more.z(), -10 * (stiff.density_kg_m3 - 1000) * geometry::signed_volume(c[0], c[1], c[2], c[3]),
              1e-12);
}

TEST_F(StiffnessTest, LabelsWithoutMaterialsOfTheirOwnChangeNoBit) {
  geometry::TetraMesh labelled = mesh;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    labelled.regions.push_back(static_cast<std::int32_t>(t % 3));
  EXPECT_EQ(assemble_stiffness(labelled, kMaterial).block, K.block);
}

}  // namespace
}  // namespace omentum::physics
