// Shapes that are made of a few numbers: turned parts, a unit arrow, a ball, the ground.
#pragma once

#include "render_node/camera.h"
#include "render_node/renderer.h"

#include <optional>

namespace omentum::render {

/// Smooth normals except over edges sharper than the crease angle, where corners are doubled.
MeshData creased(const std::vector<Vec3f>& points, const std::vector<MeshTriangle>& triangles);

/// A profile (radius, height along z), m, turned about z; listed so that the outside lies on its right when
/// it is drawn with the radius to the right and z up, i.e. from the bottom upwards for a solid. Radius 0
/// closes it.
struct ProfilePoint {
  float radius, z;
};
MeshData turned(std::span<const ProfilePoint> profile, int segments);

/// Along +z: a shaft of radius 1 from z = 0 to 1, and a head (cone) from z = 0, radius 1, to z = 1. Drawn
/// scaled.
MeshData unit_shaft();
MeshData unit_head();
/// Radius 1 about the origin.
MeshData unit_ball();

/// The share of the light from all around that a surface leaves to each vertex: 1 less the form factors of
/// about `samples` of its elements.
std::vector<float> light_left(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                              double surface_area_m2, std::size_t samples, std::span<const Vertex> to);

/// `openness` of a drape: the share of the sky that the surface above leaves free
/// (light_left()).
void shade_ground(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                  double surface_area_m2, std::size_t samples, MeshData& ground);

/// A round drape under an organ, in W, shaded by it, so that it seems to rest on it. It lies just below the
/// lowest place, or at `height_m` where that is lower.
MeshData ground_under(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                      const Ball& ball, double surface_area_m2, std::optional<double> height_m = {});

}  // namespace omentum::render
