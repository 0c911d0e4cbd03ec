// Which points of the tools touch which body, and where: found by sweeping, followed by sliding.
#pragma once

#include "haptic_node/haptic_model.h"

#include <limits>

namespace omentum::haptic {

/// A tool in this tick.
struct ToolInput {
  bool engaged = false;    // a pose is known; else the tool touches nothing
  bool relocated = false;  // it did not come here by moving: contacts are let go, nothing is swept
  bool silent = false;     // not heard of for a moment, and not engaged: jaws that hold go on holding
  // relocated after such a moment: jaws that hold are engaged, and slipped by the way
  bool heard_again = false;
  ToolFrame frame;  // as measured
  double grip = 0;  // jaw opening, rad
  // the stiffest wall that its device renders, N/m
  double max_stiffness_n_m = std::numeric_limits<double>::infinity();
  // what its safety lets the hand have (ForceSafety::covered_j), J
  double covered_j = std::numeric_limits<double>::infinity();
};

/// Whether a tool's input can be computed with: finite, and a device of some stiffness. One that cannot is
/// not engaged, and nobody else notices.
bool is_sound(const ToolInput& input) noexcept;

/// No contacts, no forces: the tools are where they are, and begin anew.
void let_go_of_everything(HapticState& state) noexcept;

/// Moves the tools' points to this tick's poses, lets go of what disengaged or relocated tools held, and
/// begins or ends grasps.
void place_tools(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                 Bodies& bodies) noexcept;

/// Makes the neighbourhood of every tool's path exact, as far above a surface as the tool may be in touch
/// with it.
void evaluate_neighbourhood(HapticState& state, Bodies& bodies) noexcept;

/// Moves the material points of contacts that slide to the nearest point of the deformed surface, and renews
/// normals.
void follow_surface(const HapticModel& model, HapticState& state, Bodies& bodies) noexcept;

/// Adds contacts for points without force that a surface passed over since the last tick, that entered it
/// on their way (swept segment against every triangle in the buckets that it crosses), or that are so near
/// that the next tick may press them: who is in the problem before it touches begins at zero.
void find_contacts(HapticState& state, Bodies& bodies) noexcept;

/// Moves contacts that are open by more than what the tools' ways can close in this tick, as far as one can
/// tell, behind the others. Returns how many others there are; they keep their order.
int set_open_aside(HapticState& state) noexcept;

/// Lets go of contacts without force that are open by more than a hair.
void release_contacts(HapticState& state, std::span<const Vec3> gaps) noexcept;

/// p - X: the tool's point minus the rest position of its material point, m; less what a grasp keeps, and
/// without the depth in which the point appeared.
Vec3 free_gap(const HapticState& state, const ToolContact& contact) noexcept;

}  // namespace omentum::haptic
