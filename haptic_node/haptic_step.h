// One tick of the hand's loop, without threads, topics or clocks.
#pragma once

#include "haptic_node/tool_contact.h"

namespace omentum::haptic {

/// The model's own answer to one tool, before force safety.
struct ToolOutput {
  Vec3 force = Vec3::Zero();   // on the hand at the tip, in W, N
  Vec3 torque = Vec3::Zero();  // on the hand about the tip, in W, N m
  double grip_torque = 0;      // on the jaws, N m, positive opens (jaws.h)
  double stored_j = 0;         // what its contacts hold for the hand: its account (contact_energy.h)
  double share = 1;            // of the model's force, that is felt and borne (see contact_energy.h)
  int touching = 0;            // contacts with a force
  bool grasping = false;
  double pull_n = 0;  // at what its jaws hold (jaws.h), as it is felt, N
  std::uint64_t grasp_count = 0;
};

/// One entry per tool of the model.
struct StepResult {
  int contacts = 0;       // contacts with a force, all tools
  int nodes = 0;          // nodes with a force, all tools
  int neighbourhood = 0;  // nodes superposed in this tick
  physics::ContactStatus status = physics::ContactStatus::kConverged;
  double residual_m = 0;
};

/// Poses in, forces out: collides with all bodies under the last tick's forces, solves the contacts of all
/// tools together on C_AA (Cotin 1999, section 4-2), and hands the new forces to the bodies. The force on a
/// hand is minus the sum of its contacts' forces on the tissue, times the share that keeps its energy, and
/// the side force that goes with it (contact_energy.h). Quasi-static: no time step enters.
///
/// `inputs` and `outputs`: [tools]. No allocation, no lock, no file. One thread.
StepResult haptic_step(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                       HapticWorkspace& work, std::span<ToolOutput> outputs) noexcept;

/// u_A = C_AA f_A of one of a body's nodes in contact, all tools' forces together, from its rest in the
/// organ's file, m; in double.
Vec3 contact_displacement(BodyId body, SurfaceId node, const HapticState& state, Bodies& bodies) noexcept;

}  // namespace omentum::haptic
