#include "physics/dynamics/tearing.h"

#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace omentum::physics {
namespace {

using geometry::TetId;
using geometry::Vec3;

constexpr Material kTissue{.young_pa = 6000, .poisson = 0.4, .density_kg_m3 = 1000};
constexpr double kLength_m = 0.1;
constexpr double kRounding = 1e-12;  // relative, of sums of a few products

class TearingTest : public testing::Test {
 protected:
  /// u = (F - 1) x everywhere.
  std::vector<double> deformed(const Eigen::Matrix3d& F) const {
    std::vector<double> u;
    for (const Vec3& x : mesh_.positions)
      for (const double component : Vec3(F * x - x)) u.push_back(component);
    return u;
  }
  /// Stretched along x, the more the greater x is.
  std::vector<double> drawn_out(double per_m) const {
    std::vector<double> u;
    for (const Vec3& x : mesh_.positions) u.insert(u.end(), {per_m * x.x() * x.x(), 0, 0});
    return u;
  }
  Tearing limited(const TearLimits& limits) const {
    return {mesh_, MaterialMap(kTissue), std::vector(mesh_.tetrahedra.size(), limits)};
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(8, 2, 2, Vec3(kLength_m, 0.03, 0.03));
};

TEST_F(TearingTest, TheCriteriaAreThoseOfAUniformStretch) {
  const double s = 1.3;
  const Tearing tearing = limited({});
  const auto u = deformed(Eigen::Vector3d(s, s, s).asDiagonal());
  const double E = (s * s - 1) / 2;
  const double S = 3 * kTissue.lambda() * E + 2 * kTissue.mu() * E;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    const TetStrain strain = tearing.strain(TetId(t), u);
    EXPECT_NEAR(strain.volume_change, s * s * s - 1, kRounding);
    EXPECT_NEAR(strain.mean_elongation, s - 1, kRounding);
    EXPECT_NEAR(strain.edge_elongation, s - 1, kRounding);
    EXPECT_NEAR(strain.stress_pa, S, S * kRounding);
  }
}

TEST_F(TearingTest, ASmallStretchHasTheStressOfHookesLaw) {
  const double eps = 1e-6;
  const Tearing tearing = limited({});
  const double nu = kTissue.poisson;
  const auto u = deformed(Eigen::Vector3d(1 + eps, 1 - nu * eps, 1 - nu * eps).asDiagonal());
  EXPECT_NEAR(tearing.strain(TetId(0), u).stress_pa, kTissue.young_pa * eps,
              kTissue.young_pa * eps * 10 * eps);
}

TEST_F(TearingTest, ARigidMotionLoadsNothing) {
  const Eigen::Matrix3d R(Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()));
  const TetStrain strain = limited({}).strain(TetId(3), deformed(R));
  EXPECT_NEAR(strain.volume_change, 0, kRounding);
  EXPECT_NEAR(strain.mean_elongation, 0, kRounding);
  EXPECT_NEAR(strain.edge_elongation, 0, kRounding);
  EXPECT_NEAR(strain.stress_pa, 0, kRounding * kTissue.young_pa);
}

TEST_F(TearingTest, SqueezedTissueIsNotDrawnOut) {
  const TetStrain strain = limited({}).strain(TetId(0), deformed(0.8 * Eigen::Matrix3d::Identity()));
  EXPECT_LT(strain.edge_elongation, 0);
  EXPECT_LT(strain.stress_pa, 0);
  EXPECT_GT(strain.volume_change, 0) << "it is crushed all the same";
}

TEST_F(TearingTest, EachLimitTearsByItself) {
  const auto u = deformed(Eigen::Vector3d(1.5, 1, 1).asDiagonal());
  EXPECT_TRUE(limited({}).check(u, {}, 100).empty()) << "what has no limit does not tear";
  const TearLimits each[] = {{.volume_change = 0.4},
                             {.mean_elongation = 0.1},
                             {.edge_elongation = 0.4},
                             {.stress_pa = 0.4 * kTissue.young_pa}};
  for (const TearLimits& limits : each) {
    EXPECT_FALSE(limited(limits).check(u, {}, 100).empty());
    EXPECT_TRUE(limited(limits).check(deformed(Eigen::Matrix3d::Identity()), {}, 100).empty()) << "at rest";
  }
}

TEST_F(TearingTest, TheMostLoadedGoFirstAndNeverTwoAtOneNode) {
  Tearing tearing = limited({.edge_elongation = 0.01});
  const auto u = drawn_out(4);
  const auto torn = tearing.check(u, {}, 4);
  ASSERT_GE(torn.size(), 2u);
  EXPECT_LE(torn.size(), 4u);
  double before = 0;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    before = std::max(before, tearing.strain(TetId(t), u).edge_elongation);
  EXPECT_EQ(tearing.strain(torn[0], u).edge_elongation, before);
  for (std::size_t i = 0; i < torn.size(); ++i) {
    EXPECT_LE(tearing.strain(torn[i], u).edge_elongation, before);
    before = tearing.strain(torn[i], u).edge_elongation;
    for (std::size_t j = 0; j < i; ++j)
      for (const auto a : mesh_.tetrahedra[torn[i]])
        for (const auto b : mesh_.tetrahedra[torn[j]]) EXPECT_NE(a, b) << torn[i] << " and " << torn[j];
  }
}

TEST_F(TearingTest, WhatIsGoneDoesNotTearAgain) {
  Tearing tearing = limited({.edge_elongation = 0.01});
  std::vector<std::uint8_t> removed((mesh_.tetrahedra.size() + 7) / 8);
  for (int i = 0; i < 20; ++i) {
    for (const TetId t : tearing.check(drawn_out(4), removed, 3)) {
      auto& byte = removed[static_cast<std::size_t>(t / 8)];
      EXPECT_EQ(byte >> t % 8 & 1, 0) << t;
      byte = static_cast<std::uint8_t>(byte | 1 << t % 8);
    }
  }
}

TEST_F(TearingTest, EachTetrahedronHasLimitsOfItsOwn) {
  std::vector<TearLimits> limits(mesh_.tetrahedra.size());
  limits[5] = {.volume_change = 0.1};
  Tearing tearing(mesh_, MaterialMap(kTissue), limits);
  const auto torn = tearing.check(deformed(1.2 * Eigen::Matrix3d::Identity()), {}, 100);
  ASSERT_EQ(torn.size(), 1u);
  EXPECT_EQ(torn[0], TetId(5));
}

TEST_F(TearingTest, ItTakesNoMemory) {
  Tearing tearing = limited({.edge_elongation = 0.01, .stress_pa = 1});
  const auto u = drawn_out(4);
  const std::size_t before = test::heap_allocations();
  const std::size_t torn = tearing.check(u, {}, 1000).size();
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(torn, 0u);
}

}  // namespace
}  // namespace omentum::physics
