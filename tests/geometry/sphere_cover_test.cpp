#include "geometry/sphere_cover.h"

#include "geometry/closest_points.h"
#include "geometry/surface.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::geometry {
namespace {

bool is_inside(const TetraMesh& mesh, const Vec3& x) {
  return std::ranges::any_of(mesh.tetrahedra, [&](const Tetrahedron& t) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Vec3, 4> at;
      for (std::size_t c = 0; c < 4; ++c) at[c] = c == i ? x : mesh.positions[t[c]];
      if (signed_volume(at[0], at[1], at[2], at[3]) < 0) return false;
    }
    return true;
  });
}

double from_surface(const TetraMesh& mesh, const Surface& surface, const Vec3& x) {
  double least_m2 = 1e30;
  for (const Triangle& t : surface.triangles)
    least_m2 = std::min(least_m2, closest_point_on_triangle(x, mesh.positions[surface.node[t[0]]],
                                                            mesh.positions[surface.node[t[1]]],
                                                            mesh.positions[surface.node[t[2]]])
                                      .squared_distance);
  return std::sqrt(least_m2);
}

/// A box of kidney's size, a flat plate and, where the data is there, a liver.
std::vector<TetraMesh> meshes() {
  std::vector<TetraMesh> all{test::make_box_mesh(6, 5, 4, Vec3(0.12, 0.10, 0.08)),
                             test::make_box_mesh(20, 20, 1, Vec3(0.2, 0.2, 0.01))};
  const auto liver = test::data_file("tet/openhelp_liver_7k.msh");
  if (std::filesystem::exists(liver)) all.push_back(check_mesh(read_mesh(liver), 0.001).mesh);
  return all;
}

TEST(SphereCover, TheSurfaceHasNoGapBetweenSomeHundredSpheres) {
  for (const TetraMesh& mesh : meshes()) {
    const Surface surface = extract_surface(mesh, {});
    const SphereCover cover = cover_with_spheres(mesh, surface);
    EXPECT_GT(cover.spheres.size(), 100u);
    EXPECT_LT(cover.spheres.size(), 800u);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share;
    for (const Triangle& t : surface.triangles) {
      const auto at = [&](std::size_t i) { return mesh.positions[surface.node[t[i]]]; };
      const double a = share(random), b = (1 - a) * share(random);
      const Vec3 x = a * at(0) + b * at(1) + (1 - a - b) * at(2);
      EXPECT_TRUE(std::ranges::any_of(cover.spheres, [&](const CoverSphere& sphere) {
        return (x - sphere.centre).norm() <= sphere.radius_m * (1 + 1e-12);
      })) << x.transpose();
    }
  }
}

TEST(SphereCover, NoSphereStandsOutFartherThanTheSpacingAndMostAThirdOfIt) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const TetraMesh& mesh : meshes()) {
    const Surface surface = extract_surface(mesh, {});
    const SphereCover cover = cover_with_spheres(mesh, surface);
    int out = 0, far_out = 0;
    for (const CoverSphere& sphere : cover.spheres) {
      EXPECT_LE(sphere.radius_m, cover.spacing_m);
      for (int i = 0; i < std::max(1, test::tried(6)); ++i) {
        const Vec3 way = Vec3(normal(random), normal(random), normal(random)).normalized();
        const Vec3 x = sphere.centre + sphere.radius_m * way;
        if (is_inside(mesh, x)) continue;
        const double out_m = from_surface(mesh, surface, x);
        EXPECT_LE(out_m, cover.spacing_m);
        ++out;
        far_out += out_m > 0.4 * cover.spacing_m ? 1 : 0;
      }
    }
    EXPECT_LT(far_out, out / 2);
  }
}

TEST(SphereCover, ItsCentresAreWhereTheirTetrahedraSay) {
  for (const TetraMesh& mesh : meshes()) {
    const SphereCover cover = cover_with_spheres(mesh, extract_surface(mesh, {}));
    for (const CoverSphere& sphere : cover.spheres) {
      Vec3 centre = Vec3::Zero();
      for (std::size_t c = 0; c < 4; ++c)
        centre += sphere.weights[static_cast<Eigen::Index>(c)] *
                  mesh.positions[mesh.tetrahedra[sphere.tetrahedron][c]];
      EXPECT_LT((centre - sphere.centre).norm(), 1e-9);
      EXPECT_GT(sphere.weights.minCoeff(), -1e-9);
      EXPECT_NEAR(sphere.place.sum(), 1, 1e-9);
      EXPECT_GT(sphere.place.minCoeff(), -1e-9);
    }
  }
}

// Nodes of a box moved into a line with their neighbours: triangles of the surface without area.
TEST(SphereCover, ATriangleWithoutAreaSpoilsNothing) {
  TetraMesh mesh = test::make_box_mesh(4, 4, 3, Vec3(0.12, 0.10, 0.08));
  const Surface surface = extract_surface(mesh, {});
  const Triangle& t = surface.triangles[0];
  const auto at = [&](std::size_t i) -> Vec3& { return mesh.positions[surface.node[t[i]]]; };
  at(2) = (at(0) + at(1)) / 2;
  const SphereCover cover = cover_with_spheres(mesh, surface);
  EXPECT_GT(cover.spheres.size(), 50u);
  for (const CoverSphere& sphere : cover.spheres) {
    EXPECT_NE(sphere.below, TriangleId(0));
    EXPECT_TRUE(sphere.place.allFinite());
    EXPECT_TRUE(sphere.centre.allFinite());
    EXPECT_TRUE(std::isfinite(sphere.radius_m));
  }
}

}  // namespace
}  // namespace omentum::geometry
