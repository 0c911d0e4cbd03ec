// Which points of the tools touch the surface, and where: found by sweeping, followed by sliding.
#pragma once

#include "haptic_node/haptic_model.h"

#include <limits>

namespace omentum::haptic {

/// A tool in this tick.
struct ToolInput {
  bool engaged = false;    // a pose is known; else the tool touches nothing
  bool relocated = false;  // it did not come here by moving: contacts are let go, nothing is swept
  ToolFrame frame;         // as measured
  double grip = 0;         // jaw opening, rad
  // the stiffest wall that its device renders, N/m
  double max_stiffness_n_m = std::numeric_limits<double>::infinity();
};

/// Moves the tools' points to this tick's poses, lets go of what disengaged or relocated tools held, and
/// begins or ends grasps.
void place_tools(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                 DeformedSurface& surface) noexcept;

/// Makes the neighbourhood of every tool's path exact.
void evaluate_neighbourhood(const HapticState& state, DeformedSurface& surface) noexcept;

/// Moves the material points of contacts that slide to the nearest point of the deformed surface, and renews
/// normals.
void follow_surface(const HapticModel& model, HapticState& state, DeformedSurface& surface) noexcept;

/// Adds contacts for points without force that the surface passed over since the last tick, or that entered
/// it on their way (swept segment against every triangle in the buckets that it crosses).
void find_contacts(HapticState& state, DeformedSurface& surface) noexcept;

/// Points of a tool that is inside the organ without having come there by moving (a device or node that was
/// started again): each holds the nearest surface point from where it is. It is not pushed out, is held back
/// from going deeper at once, may leave freely, and outside is a point like any other. What of a tool's
/// points would leave through another side of the organ than most holds nothing until it left.
void meet_appeared(HapticState& state, DeformedSurface& surface) noexcept;

/// Lets go of contacts without force that are open by more than a hair.
void release_contacts(HapticState& state, std::span<const Vec3> gaps) noexcept;

/// p - X: the tool's point minus the rest position of its material point, m; less what a grasp keeps, and
/// without the depth in which the point appeared.
Vec3 free_gap(const HapticState& state, const ToolContact& contact, const DeformedSurface& surface) noexcept;

}  // namespace omentum::haptic
