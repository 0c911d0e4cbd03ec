// Where the scene is looked at from: an orbiting camera, or one that scope_view.h makes.
#pragma once

#include "geometry/types.h"
#include "render_node/renderer.h"
#include "scene/scene.h"

#include <Eigen/Geometry>

namespace omentum::render {

using geometry::Vec3;

/// A ball that holds everything that must be seen, m.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0.1;
};
/// Around the box of `points` (not the smallest ball, but at most 1.8 times it).
Ball ball_around(std::span<const Vec3> points);

/// A pinhole camera in W; field of view from bottom to top.
struct Camera {
  Vec3 eye = Vec3::UnitX();
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double field_of_view_deg = 40;

  double distance() const { return (target - eye).norm(); }
  Vec3 forward() const { return (target - eye).normalized(); }
};

/// The scene's camera; where it gives none (eye == target == 0), one that shows the whole ball from `from`
/// (a direction, need not be unit).
Camera start_camera(const scene::CameraSpec& spec, const Ball& ball, const Vec3& from, float aspect);

/// Turns about the target; yaw about `up`, then pitch, which stops short of the poles. rad.
Camera orbited(const Camera& camera, double yaw_rad, double pitch_rad);
/// Halves or doubles the distance about every seven steps of the wheel; stays within [min, max] metres.
Camera zoomed(const Camera& camera, double steps, double min_m, double max_m);
/// Moves eye and target so that the target's point follows the mouse; fractions of the picture's height.
Camera panned(const Camera& camera, double right, double up);

/// `shift` moves the picture's middle to the right by that fraction of its width (room for a panel).
View view_of(const Camera& camera, const Ball& ball, float aspect, double shift);

}  // namespace omentum::render
