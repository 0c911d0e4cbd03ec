// A grasper's two jaws: where they carry its points, and how what lies between them pushes them open.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// Jaws do not open wider, rad.
inline constexpr double kWidest_rad = 1.5;

/// On which jaw a tool's point is: +1, the one that opens towards T's +x, -1, the other one, and 0 for what
/// does not turn: the middle, where both meet, and all that is behind the hinge.
int jaw_of(const ToolModel& tool, const Vec3& p_TP) noexcept;

/// Where a point is in T, m, when the jaws are open by `grip` (rad): each jaw turns by half of it about y at
/// the hinge h = (0, 0, kJawLength_m),
///     p(g) = h + R_y(-s g / 2) (p - h),   s = jaw_of(p).
Vec3 at_opening(const ToolModel& tool, const Vec3& p_TP, double grip) noexcept;

/// The share of a contact in the torque on the jaws, N m, positive opens. Opening by dg moves the point by
/// dp/dg dg, so that by virtual work a force f on the tissue, -f on the jaw, turns the jaws with
///     t_g = -f . dp/dg,   dp/dg = -s/2 y x (p(g) - h) in T:
/// half of the force's moment about the hinge, since each jaw turns by half of what the grip does. It is
/// minus the gradient of the contacts' energy with respect to the grip, as the force on the hand is with
/// respect to its place: what closing puts in is what opening gives back. What jaws do not hold counts where
/// it lies between them and pushes them open; closed jaws that hold nothing have nothing between them.
/// `felt`: of the contact's force on the tissue, in W, N.
double grip_torque(const ToolModel& model, const ToolState& tool, const ToolContact& contact,
                   const Vec3& felt) noexcept;

/// What pulls at the jaws of a tool that grasps, N: all forces of what they hold together, less what presses
/// them against the tissue along the shaft, by which nothing slips out.
double pull_n(const HapticState& state, std::int32_t tool) noexcept;

/// Jaws that close begin to hold what lies between them, jaws that open let go, and tissue that is pulled
/// harder than they grip, for some ticks, slips out of them. What gap there was when they began to hold
/// stays, so that no force comes from holding alone; from there on closing presses the tissue together.
void follow_grip(const HapticModel& model, HapticState& state, std::int32_t tool, double grip,
                 Bodies& bodies) noexcept;

/// The tool holds nothing any more.
void end_grasp(HapticState& state, std::int32_t tool) noexcept;

}  // namespace omentum::haptic
