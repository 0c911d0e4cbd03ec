// How far a surface is stretched along itself.
#include "physics/membrane_strain.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace omentum::physics {
namespace {

using geometry::Vec3;

constexpr double kFloat =
    1e-5;  // places of a box of 0.1 m, and triangles of a third of that, in single precision

/// The surface of a box, moved.
struct Moved {
  explicit Moved(const Eigen::Matrix3d& map, const Vec3& by = Vec3::Zero()) {
    std::vector<float> u;
    for (const Vec3& p : rest)
      for (const double component : Vec3(map * p + by - p)) u.push_back(static_cast<float>(component));
    strain.resize(rest.size(), -1);
    MembraneStrain(surface, rest).measure(u, strain);
  }
  geometry::TetraMesh mesh = test::make_box_mesh(3, 3, 3, Vec3(0.1, 0.1, 0.1));
  geometry::Surface surface = geometry::extract_surface(mesh, {});
  std::vector<Vec3> rest = geometry::surface_positions(mesh, surface);
  std::vector<float> strain;
};

TEST(MembraneStrain, RigidMotionHasNone) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  for (const float strain : Moved(turn, {0.3, -1, 2}).strain) EXPECT_NEAR(strain, 0, kFloat);
}

TEST(MembraneStrain, IsTheChangeOfLengthWhateverTheTurn) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(3, 1, 1).normalized()).toRotationMatrix();
  for (const float strain : Moved(turn * 1.2).strain) EXPECT_NEAR(strain, 0.2, kFloat);
  for (const float strain : Moved(turn * 0.9).strain) EXPECT_NEAR(strain, -0.1, kFloat);
}

TEST(MembraneStrain, OfAShearIsThatOfItsPrincipalStretch) {
  // F = [1 g; 0 1]: lambda^2 = 1 + g^2 / 2 + g sqrt(1 + g^2 / 4)
  constexpr double g = 0.4;
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = g;
  const double longest = std::sqrt(1 + g * g / 2 + g * std::sqrt(1 + g * g / 4)) - 1;
  const Moved moved(shear);
  int seen = 0;
  for (std::size_t s = 0; s < moved.rest.size(); ++s) {
    const bool inside_top = moved.rest[s].z() > 0.099 && moved.rest[s].head<2>().minCoeff() > 0.01 &&
                            moved.rest[s].head<2>().maxCoeff() < 0.09;
    if (!inside_top) continue;
    EXPECT_NEAR(moved.strain[s], longest, kFloat);
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

TEST(MembraneStrain, ANodeWithoutTrianglesHasNone) {
  const geometry::Surface surface = geometry::surface_of_triangles(1, {});
  const std::vector<Vec3> rest(1, Vec3::Zero());
  std::vector<float> strain{1};
  MembraneStrain(surface, rest).measure(std::vector<float>{1, 1, 1}, strain);
  EXPECT_EQ(strain[0], 0);
}

}  // namespace
}  // namespace omentum::physics
