#include "physics/intestine/gut_obstacle.h"

#include "tests/physics/intestine/restless_gut.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::Vec3;

GutObstacle turned(GutObstacle::Kind kind) {
  GutObstacle obstacle{.kind = kind, .centre = Vec3(0.1, -0.2, 0.3), .half_axes_m = Vec3(0.2, 0.15, 0.1)};
  obstacle.axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return obstacle;
}

// By many points of the ellipsoid's surface.
double searched_distance(const GutObstacle& obstacle, const Vec3& p) {
  double least = 1e9;
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j < 800; ++j) {
      const double polar = i * EIGEN_PI / 400, round = j * EIGEN_PI / 400;
      const Vec3 unit(std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar));
      const Vec3 surface = obstacle.centre + obstacle.axes * obstacle.half_axes_m.cwiseProduct(unit);
      least = std::min(least, (surface - p).norm());
    }
  }
  return least;
}

TEST(GutObstacle, DepthInAnEllipsoidIsTheDistanceFromItsSurface) {
  const GutObstacle obstacle = turned(GutObstacle::Kind::kInsideEllipsoid);
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 12; ++trial) {
    const Vec3 p = obstacle.centre + test::random_vector(random, 0.2);
    const WallPlace place = place_at_wall(obstacle, p);
    const bool inside =
        (obstacle.axes.transpose() * (p - obstacle.centre)).cwiseQuotient(obstacle.half_axes_m).norm() < 1;
    EXPECT_EQ(place.depth_m > 0, inside);
    EXPECT_NEAR(std::abs(place.depth_m), searched_distance(obstacle, p),
                2e-5);  // the search's own coarseness
    const Vec3 at = obstacle.axes.transpose() * (p - place.depth_m * place.inward - obstacle.centre);
    EXPECT_NEAR(at.cwiseQuotient(obstacle.half_axes_m).norm(), 1, 1e-9);
  }
}

TEST(GutObstacle, MiddleAndPlanesOfSymmetryAreNoExceptions) {
  GutObstacle obstacle{.kind = GutObstacle::Kind::kInsideEllipsoid, .half_axes_m = Vec3(0.2, 0.15, 0.1)};
  EXPECT_NEAR(place_at_wall(obstacle, Vec3::Zero()).depth_m, 0.1, 1e-8);
  EXPECT_NEAR(place_at_wall(obstacle, Vec3(0.3, 0, 0)).depth_m, -0.1, 1e-8);
  EXPECT_NEAR(place_at_wall(obstacle, Vec3(0, 0, -0.09)).depth_m, 0.01, 1e-8);
  obstacle.half_axes_m.setConstant(0.1);
  EXPECT_NEAR(place_at_wall(obstacle, Vec3(0.03, 0, 0)).depth_m, 0.07, 1e-8);
}

TEST(GutObstacle, PlaneAndBoxSayHowFarInside) {
  GutObstacle plane{.centre = Vec3(0, 0, 1)};
  EXPECT_NEAR(place_at_wall(plane, Vec3(5, 5, 1.5)).depth_m, 0.5, 1e-15);
  EXPECT_EQ(place_at_wall(plane, Vec3(5, 5, 1.5)).inward, Vec3::UnitZ());
  const GutObstacle box = turned(GutObstacle::Kind::kInsideBox);
  const WallPlace place = place_at_wall(box, box.centre + box.axes * Vec3(0, 0.14, 0));
  EXPECT_NEAR(place.depth_m, 0.01, 1e-12);
  EXPECT_LT((place.inward + box.axes.col(1)).norm(), 1e-12);
}

// Most points are told apart by a bound alone, which must not miss any.
TEST(GutObstacle, AnEllipsoidTellsWhatIsNearItAndNothingElse) {
  const GutObstacle obstacle = turned(GutObstacle::Kind::kInsideEllipsoid);
  std::mt19937_64 random(5);
  std::size_t near = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p = obstacle.centre + test::random_vector(random, 0.15);
    const double reach_m = 0.02, depth_m = place_at_wall(obstacle, p).depth_m;
    const WallFaces faces = faces_within(obstacle, p, reach_m);
    ASSERT_EQ(faces.count, depth_m < reach_m ? 1u : 0u) << depth_m;
    near += faces.count;
    if (faces.count == 0) continue;
    EXPECT_EQ(faces.near()[0].depth_m, depth_m);
  }
  EXPECT_GT(near, 300u);
  EXPECT_LT(near, 1900u);
}

TEST(GutObstacle, ABoxTellsEveryFaceOfItsCorners) {
  const GutObstacle box = turned(GutObstacle::Kind::kInsideBox);
  const auto at = [&](double x, double y, double z) { return Vec3(box.centre + box.axes * Vec3(x, y, z)); };
  EXPECT_EQ(faces_within(box, at(0, 0, 0), 0.02).count, 0u);
  EXPECT_EQ(faces_within(box, at(0.19, 0, 0), 0.02).count, 1u);
  EXPECT_EQ(faces_within(box, at(0.19, 0.14, 0), 0.02).count, 2u);
  const Vec3 corner = at(0.19, -0.145, 0.12);  // beyond the third face
  const WallFaces faces = faces_within(box, corner, 0.02);
  ASSERT_EQ(faces.count, 3u);
  for (const WallPlace& place : faces.near()) {
    const Vec3 foot = box.axes.transpose() * (corner - place.depth_m * place.inward - box.centre);
    EXPECT_NEAR((foot.cwiseAbs() - box.half_axes_m).cwiseAbs().minCoeff(), 0, 1e-12);
  }
  EXPECT_EQ(place_at_wall(box, corner).depth_m, faces.places[2].depth_m);
}

}  // namespace
}  // namespace omentum::physics
