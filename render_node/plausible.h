// What may reach the camera and the picture: anybody can write a sample.
#pragma once

#include "render_node/camera.h"
#include "transport/messages.h"

#include <span>

namespace omentum::render {

/// No instrument is farther from the scene's origin, m: an operating theatre is smaller, and floats still see
/// a hundredth of a millimetre there.
inline constexpr double kRoom_m = 100;
/// No node of an organ moves farther than so many of its own diagonals: linear elasticity is trusted to a
/// tenth of one, and a wrong press may be ten times too deep.
inline constexpr double kReachDiagonals = 4;

/// A place in the room and a rotation.
bool is_plausible(const msg::ToolPose& pose);
/// A force that haptic_node lets out (`max_force_n`: the scene's).
bool is_plausible(const msg::ToolForce& force, double max_force_n);
/// Forces on tissue (node_common/contact_bounds.h). Nodes are looked up, and left out, where they are drawn.
bool is_plausible(const msg::Contact& contact, double max_force_n);

/// How far a node of the organ that lies so at rest may move, m.
double reach_of(std::span<const Vec3> rest);

}  // namespace omentum::render
