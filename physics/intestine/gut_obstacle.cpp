#include "physics/intestine/gut_obstacle.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Steps of Newton's method, at most; from a start that is far outside each one halves the distance at least.
constexpr int kSteps = 64;

// Closest point of the surface to y (first octant, half axes e): x_i = e_i^2 y_i / (t + e_i^2) with the
// largest root t of F(t) = sum (e_i y_i / (t + e_i^2))^2 - 1 (Eberly, "Distance from a point to an ellipse,
// an ellipsoid or a hyperellipsoid"). F falls and is convex there: from the left Newton's method cannot miss
// it.
Vec3 closest_on_ellipsoid(const Vec3& y, const Vec3& e) {
  const Eigen::Array3d squares = e.array().square(), product = e.array() * y.array();
  double t = (product - squares).maxCoeff();
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Array3d ratio = product / (squares + t);
    const double excess = ratio.square().sum() - 1, slope = 2 * (ratio.square() / (squares + t)).sum();
    const double next = t + excess / slope;
    if (!(next > t)) break;
    t = next;
  }
  return squares * y.array() / (squares + t);
}

// On the shortest axis' plane of symmetry the closest point may lie off it, with any sign: y is moved there
// by this part of the half axis, far below any length that counts.
constexpr double kOffSymmetry = 1e-9;

WallPlace in_ellipsoid(const Vec3& p, const Vec3& e) {
  const Vec3 y = p.cwiseAbs().cwiseMax(kOffSymmetry * e);
  const Vec3 sign(std::copysign(1.0, p.x()), std::copysign(1.0, p.y()), std::copysign(1.0, p.z()));
  const Vec3 surface = closest_on_ellipsoid(y, e);
  const Vec3 inward = -surface.cwiseQuotient(e.cwiseAbs2()).normalized();
  return {(y - surface).dot(inward), sign.cwiseProduct(inward)};
}

// Of a box' faces: two on each axis, on its positive side first.
WallPlace at_face(std::int32_t face, const Vec3& p, const Vec3& half) {
  const Eigen::Index axis = face / 2;
  const double side = face % 2 == 0 ? 1 : -1;
  return {half[axis] - side * p[axis], -side * Vec3::Unit(axis), face};
}

WallPlace in_box(const Vec3& p, const Vec3& half) {
  WallPlace nearest = at_face(0, p, half);
  for (std::int32_t face = 1; face < WallFaces::kMostFaces; ++face) {
    const WallPlace place = at_face(face, p, half);
    if (place.depth_m < nearest.depth_m) nearest = place;
  }
  return nearest;
}

// In the obstacle's own axes.
Vec3 in_own_axes(const GutObstacle& obstacle, const Vec3& p) {
  return obstacle.axes.transpose() * (p - obstacle.centre);
}

}  // namespace

WallPlace place_at_wall(const GutObstacle& obstacle, const Vec3& p) noexcept {
  const Vec3 own = in_own_axes(obstacle, p);
  WallPlace place{own.z(), Vec3::UnitZ()};
  if (obstacle.kind == GutObstacle::Kind::kInsideEllipsoid) place = in_ellipsoid(own, obstacle.half_axes_m);
  if (obstacle.kind == GutObstacle::Kind::kInsideBox) place = in_box(own, obstacle.half_axes_m);
  place.inward = obstacle.axes * place.inward;
  return place;
}

namespace {

// Whether a point inside an ellipsoid is that deep by its level |p / e| alone, which falls from 1 on the
// surface by no more than the way over the shortest half axis: most of a gut is, and needs no closest point.
bool is_deep(const GutObstacle& obstacle, const Vec3& p, double reach_m) {
  if (obstacle.kind != GutObstacle::Kind::kInsideEllipsoid) return false;
  const Vec3& e = obstacle.half_axes_m;
  return (1 - in_own_axes(obstacle, p).cwiseQuotient(e).norm()) * e.minCoeff() >= reach_m;
}

}  // namespace

WallFaces faces_within(const GutObstacle& obstacle, const Vec3& p, double reach_m) noexcept {
  WallFaces faces;
  if (is_deep(obstacle, p, reach_m)) return faces;
  const auto take = [&](const WallPlace& place) {
    if (place.depth_m < reach_m) faces.places[faces.count++] = place;
  };
  if (obstacle.kind != GutObstacle::Kind::kInsideBox) {
    take(place_at_wall(obstacle, p));
    return faces;
  }
  const Vec3 own = in_own_axes(obstacle, p);
  for (std::int32_t face = 0; face < WallFaces::kMostFaces; ++face) {
    WallPlace place = at_face(face, own, obstacle.half_axes_m);
    place.inward = obstacle.axes * place.inward;
    take(place);
  }
  return faces;
}

WallClearance clearance(const geometry::GutShape& gut, const GutObstacle& obstacle) noexcept {
  WallClearance least{std::numeric_limits<double>::infinity()};
  for (std::int32_t i = 0; i < gut.layout.mass_count(); ++i) {
    const geometry::MassId m(i);
    const double around_m = gut.layout.row(m) == 0 ? gut.tube_radius_m : gut.mesentery_thickness_m / 2;
    const Vec3& p = gut.positions[static_cast<std::size_t>(i)];
    const double free_m = place_at_wall(obstacle, p).depth_m - around_m;
    if (free_m < least.free_m) least = {free_m, m};
  }
  return least;
}

}  // namespace omentum::physics
