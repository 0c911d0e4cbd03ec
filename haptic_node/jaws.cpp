#include "haptic_node/jaws.h"

#include "haptic_node/contact_list.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// Jaws closer than this hold tissue, wider open than that let go, rad: at the first one their tips are as far
// apart as a fold of bowel wall is thick, 2.7 mm; the second one is apart from it so that a trembling hand
// does not drop and grasp again.
constexpr double kGraspBelow_rad = 0.15;
constexpr double kReleaseAbove_rad = 0.25;

// Jaws close on what is not farther from one of their points than this, m: a tenth of a voxel of the scans
// that organs come from. What else is near then (kNear_m of tool_contact) is between them as well.
constexpr double kGraspGap_m = 1e-4;

// Tissue slips out when it was pulled so hard for so many ticks: a single one is a step between two models.
constexpr int kSlipTicks = 10;

// A point this near to the middle is on no jaw, m.
constexpr double kMiddle_m = 1e-4;

const Vec3 kHinge(0, 0, scene::kJawLength_m);

// By how much each of the jaws has turned about y, rad.
Eigen::AngleAxisd turn_of(int jaw, double grip) {
  return {-0.5 * jaw * grip, Vec3::UnitY()};
}

// dp/dg in T, m/rad.
Vec3 opening_way(const ToolModel& tool, const Vec3& p_TP, double grip) {
  const int jaw = jaw_of(tool, p_TP);
  return -0.5 * jaw * Vec3::UnitY().cross(turn_of(jaw, grip) * (p_TP - kHinge));
}

// The gap that a contact keeps, in W: what there was in the last tick. Jaws that were shut at a blow hold as
// if they had passed where holding begins.
Vec3 gap_to_keep(const ToolModel& model, const ToolState& tool, const ToolContact& contact, Body& body) {
  const Vec3& p_TP = model.points[contact.point];
  const Vec3 skipped = at_opening(model, p_TP, std::min(tool.grip_before, kGraspBelow_rad)) -
                       at_opening(model, p_TP, tool.grip_before);
  return with_the_others(contact, tool.before) + tool.frame.q_WT * skipped - body.position(contact.held);
}

void begin_grasp(const ToolModel& model, HapticState& state, std::int32_t tool, Bodies& bodies) {
  ToolState& jaws = state.tools[tool];
  const auto touched = [&](const ToolContact& contact) {
    if (contact.tool != tool) return false;
    const Vec3 gap = with_the_others(contact, jaws.before) - bodies[contact.body].position(contact.held);
    return gap.dot(contact.place.normal) <= kGraspGap_m;
  };
  jaws.grasping = std::ranges::any_of(state.active(), touched);
  if (!jaws.grasping) return;
  ++jaws.grasp_count;
  for (ToolContact& contact : state.active()) {
    if (contact.tool != tool) continue;
    contact.offset = gap_to_keep(model, jaws, contact, bodies[contact.body]);
    contact.grasped = true;
  }
}

void slip_where_pulled(const ToolModel& model, HapticState& state, std::int32_t tool) {
  ToolState& jaws = state.tools[tool];
  const bool too_hard =
      jaws.grasping && state.energies[tool].share * pull_n(state, tool) > model.grip_force_n;
  jaws.overpulled_ticks = too_hard ? jaws.overpulled_ticks + 1 : 0;
  if (jaws.overpulled_ticks < kSlipTicks) return;
  end_grasp(state, tool);
  ++jaws.grasps.torn;
}

}  // namespace

int jaw_of(const ToolModel& tool, const Vec3& p_TP) noexcept {
  if (!tool.grasps || p_TP.z() >= kHinge.z() || std::abs(p_TP.x()) < kMiddle_m) return 0;
  return p_TP.x() > 0 ? 1 : -1;
}

Vec3 at_opening(const ToolModel& tool, const Vec3& p_TP, double grip) noexcept {
  const int jaw = jaw_of(tool, p_TP);
  return jaw == 0 || grip == 0 ? p_TP : Vec3(kHinge + turn_of(jaw, grip) * (p_TP - kHinge));
}

double grip_torque(const ToolModel& model, const ToolState& tool, const ToolContact& contact,
                   const Vec3& felt) noexcept {
  if (!tool.grasping && !tool.opened) return 0;
  const Vec3 way = tool.frame.q_WT * opening_way(model, model.points[contact.point], tool.grip);
  const double torque_nm = -felt.dot(way);
  return contact.grasped ? torque_nm : std::max(0.0, torque_nm);
}

double pull_n(const HapticState& state, std::int32_t tool) noexcept {
  Vec3 pull = Vec3::Zero();
  for (const ToolContact& contact : state.active())
    if (contact.tool == tool && contact.grasped) pull += contact.force;
  const Vec3 shaft = state.tools[tool].frame.q_WT * Vec3::UnitZ();
  return (pull - std::min(0.0, pull.dot(shaft)) * shaft).norm();
}

void end_grasp(HapticState& state, std::int32_t tool) noexcept {
  ToolState& jaws = state.tools[tool];
  // what was held is lost with it
  jaws.let_go |= jaws.grasping && state.energies[tool].stored_j > 0;
  jaws.grasping = false;
  for (ToolContact& contact : state.active()) {
    if (contact.tool == tool) contact.grasped = false;
  }
}

void follow_grip(const HapticModel& model, HapticState& state, std::int32_t tool, double grip,
                 Bodies& bodies) noexcept {
  ToolState& jaws = state.tools[tool];
  const ToolModel& tool_model = model.tools[tool];
  slip_where_pulled(tool_model, state, tool);
  if (grip > kReleaseAbove_rad) {
    jaws.opened = true;
    if (jaws.grasping) end_grasp(state, tool);
  } else if (grip < kGraspBelow_rad && jaws.opened) {
    // jaws that closed, on whatever it was, are a blunt probe when they hold nothing until they were open
    // again
    jaws.opened = false;
    begin_grasp(tool_model, state, tool, bodies);
    if (!jaws.grasping) ++jaws.grasps.empty;
  }
}

}  // namespace omentum::haptic
