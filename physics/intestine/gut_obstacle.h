// What an intestine lies on, lies in and is pushed by.
#pragma once

#include "geometry/gut_shape.h"

#include <limits>
#include <span>

namespace omentum::physics {

/// A wall that stands still. The gut stays on the side of a plane to which `axes.col(2)` points, inside an
/// ellipsoid or inside a box; of these the side is convex, so that masses that keep to it keep what lies
/// between them there too.
struct GutObstacle {
  enum class Kind : std::uint8_t { kHalfSpace, kInsideEllipsoid, kInsideBox };
  Kind kind = Kind::kHalfSpace;
  geometry::Vec3 centre = geometry::Vec3::Zero();            // a place on the plane, or the middle, in W, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();        // R_WO: the obstacle's axes in W
  geometry::Vec3 half_axes_m = geometry::Vec3::Constant(1);  // of ellipsoid or box; all > 0
};

/// A ball that comes along: a probe's tip, or a sphere of another organ.
struct MovingSphere {
  geometry::Vec3 before = geometry::Vec3::Zero();  // its centre at the start of the step, in W, m
  geometry::Vec3 after = geometry::Vec3::Zero();   // where it wants to be at the end of it, in W, m
  double radius_m = 0;
  double mass_kg = std::numeric_limits<double>::infinity();  // infinite: the gut does not slow it
  // What drives it pushes no harder, N: where more is in its way it stays behind, and `reached` says where.
  double most_force_n = std::numeric_limits<double>::infinity();
};

/// What a step made of a MovingSphere.
struct SphereOutcome {
  geometry::Vec3 reached = geometry::Vec3::Zero();  // centre, in W, m; its next `before`, if it is never to
                                                    // be on the wrong side of anything
  geometry::Vec3 impulse = geometry::Vec3::Zero();  // on the sphere, in W, N s; by the step: its mean force
};

/// How far a point is inside, m (negative: how far outside), and where to go to be farther inside, unit.
struct WallPlace {
  double depth_m = 0;
  geometry::Vec3 inward = geometry::Vec3::UnitZ();
  std::int32_t face = 0;  // of a box, below kMostFaces; else 0
};
/// To the nearest face.
WallPlace place_at_wall(const GutObstacle& obstacle, const geometry::Vec3& p) noexcept;

/// All faces to which a point is nearer than reach_m: several in the corner of a box.
struct WallFaces {
  static constexpr std::int32_t kMostFaces = 6;
  std::array<WallPlace, kMostFaces> places;
  std::size_t count = 0;
  std::span<const WallPlace> near() const { return std::span(places).first(count); }
};
WallFaces faces_within(const GutObstacle& obstacle, const geometry::Vec3& p, double reach_m) noexcept;

/// The mass of a gut that is nearest to a wall or farthest beyond it.
struct WallClearance {
  double free_m = 0;  // between what is around the mass and the wall; negative: so deep in it
  geometry::MassId mass{0};
};
/// Of the whole tube and sheet: the side of an obstacle is convex, so masses decide for what is between them.
WallClearance clearance(const geometry::GutShape& gut, const GutObstacle& obstacle) noexcept;

}  // namespace omentum::physics
