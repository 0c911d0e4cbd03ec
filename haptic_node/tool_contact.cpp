#include "haptic_node/tool_contact.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// Jaws closer than this hold tissue, wider open than that let go, rad: apart, so that a trembling hand does
// not drop and grasp again.
constexpr double kGraspBelow_rad = 0.10;
constexpr double kReleaseAbove_rad = 0.20;

// An open contact is kept as a hint up to here, m: a tenth of a voxel of the scans that organs come from.
constexpr double kReleaseGap_m = 1e-4;

// How far a point without room is looked around, m: this many times the room it had, and at least
// kShortArm_m. A point that has 1 mm of room needs no look for the next 40 ticks at 25 mm/s.
constexpr double kArmGrowth = 4;
constexpr double kShortArm_m = 2e-4;
// A point may appear this deep, m: half a liver.
constexpr double kDeepestAppearance_m = 0.06;
// Rounding of positions, m.
constexpr double kHair_m = 1e-6;

template <class Predicate>
void drop_contacts(HapticState& state, Predicate&& gone) {
  const std::span<ToolContact> active = state.active();
  const auto end = std::remove_if(active.begin(), active.end(), gone);
  state.contact_count = static_cast<int>(end - active.begin());
}

void end_grasp(HapticState& state, std::int32_t tool) {
  state.tools[tool].grasping = false;
  for (ToolContact& contact : state.active()) {
    if (contact.tool == tool) contact.grasped = false;
  }
}

void begin_grasp(HapticState& state, std::int32_t tool, DeformedSurface& surface) {
  bool holds = false;
  for (ToolContact& contact : state.active()) {
    if (contact.tool != tool) continue;
    holds = true;
    contact.grasped = true;
    // what is between jaw and tissue when they close stays there: no force comes from closing alone
    contact.offset = state.tools[tool].before[contact.point] - surface.position(contact.held) +
                     contact.sunken_m * contact.normal;
  }
  if (!holds) return;
  state.tools[tool].grasping = true;
  state.tools[tool].opened = false;
  ++state.tools[tool].grasp_count;
}

void follow_grip(HapticState& state, std::int32_t tool, double grip, DeformedSurface& surface) {
  ToolState& jaws = state.tools[tool];
  if (grip > kReleaseAbove_rad) {
    jaws.opened = true;
    if (jaws.grasping) end_grasp(state, tool);
  } else if (grip < kGraspBelow_rad && jaws.opened && !jaws.grasping) {
    begin_grasp(state, tool, surface);
    // jaws that closed on nothing are a blunt probe until they were open again
    if (!jaws.grasping) jaws.opened = false;
  }
}

Region path_of(const ToolState& tool) {
  Region region{tool.now[0], tool.now[0]};
  for (const auto* points : {&tool.before, &tool.now}) {
    for (const Vec3& p : *points) {
      region.low = region.low.cwiseMin(p);
      region.high = region.high.cwiseMax(p);
    }
  }
  return region;
}

ToolContact* contact_of(HapticState& state, std::int32_t tool, std::int32_t point) {
  for (ToolContact& contact : state.active()) {
    if (contact.tool == tool && contact.point == point) return &contact;
  }
  return nullptr;
}

ToolContact& add_contact(HapticState& state, std::int32_t tool, std::int32_t point) {
  ToolContact& contact = state.contacts[state.contact_count++];
  contact = ToolContact{};
  contact.tool = tool;
  contact.point = point;
  return contact;
}

double depth_of(const HapticState& state, const ToolContact& contact, DeformedSurface& surface) {
  const Vec3& p = state.tools[contact.tool].now[contact.point];
  return (surface.position(contact.held) - p).dot(contact.normal);
}

// The surface point that tool point p met on its way, if any. Whoever has more room than tool and surface
// moved together met nothing.
std::optional<SurfacePoint> look_around(ToolState& tool, std::size_t p, DeformedSurface& surface) {
  double& room = tool.clearance[p];
  const double before = room, way = (tool.now[p] - tool.before[p]).norm() + kHair_m;
  room = std::min(room - way - surface.known_motion(),
                  DeformedSurface::kReach_m - way - surface.entered_motion());
  if (room > 0) return std::nullopt;
  const double arm = std::clamp(kArmGrowth * before, kShortArm_m, DeformedSurface::kReach_m);
  const DeformedSurface::Encounter met = surface.meet(tool.before[p], tool.now[p], arm);
  room = met.touched ? 0 : met.clearance_m;
  return met.touched;
}

// A tool that appeared inside and goes out takes the depth with it that is no press. Only once nothing pushes
// it any more: what one point gave up while another still pressed would push later, with energy from nowhere.
void surface_with_tools(HapticState& state, DeformedSurface& surface) {
  std::uint32_t pressing = 0;
  for (const ToolContact& contact : state.active())
    pressing |= std::uint32_t{contact.touches()} << contact.tool;
  for (ToolContact& contact : state.active()) {
    if (contact.sunken_m == 0 || (pressing >> contact.tool & 1) != 0) continue;
    contact.sunken_m = std::clamp(depth_of(state, contact, surface), 0.0, contact.sunken_m);
  }
}

}  // namespace

void place_tools(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                 DeformedSurface& surface) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    ToolState& tool = state.tools[i];
    const ToolInput& input = inputs[i];
    const bool moved_here = input.engaged && tool.engaged && !input.relocated;
    if (!moved_here) {
      end_grasp(state, index);
      drop_contacts(state, [&](const ToolContact& contact) { return contact.tool == index; });
    }
    tool.engaged = input.engaged;
    tool.appeared = input.engaged && !moved_here;
    if (!input.engaged) continue;
    const auto& trocar = model.tools[i].trocar;
    tool.frame = trocar ? through_trocar(input.frame, *trocar) : input.frame;
    std::swap(tool.before, tool.now);
    for (std::size_t p = 0; p < tool.now.size(); ++p)
      tool.now[p] = to_world(tool.frame, model.tools[i].points[p]);
    if (!moved_here) {
      tool.before = tool.now;
      std::fill(tool.clearance.begin(), tool.clearance.end(), 0.0);
    }
    if (model.tools[i].grasps) follow_grip(state, index, input.grip, surface);
  }
}

void evaluate_neighbourhood(const HapticState& state, DeformedSurface& surface) noexcept {
  for (const ToolState& tool : state.tools) {
    if (tool.engaged) surface.evaluate(path_of(tool));
  }
}

void follow_surface(const HapticModel& model, HapticState& state, DeformedSurface& surface) noexcept {
  for (ToolContact& contact : state.active()) {
    if (contact.grasped) continue;
    const ToolState& tool = state.tools[contact.tool];
    if (model.friction == 0 || !contact.touches()) {
      contact.held = surface.slide(contact.held, tool.now[contact.point]);
    } else if (contact.sliding) {
      // friction is back inside its cone where the tool was; from there it moves on
      contact.held = surface.slide(contact.held, tool.before[contact.point]);
    }
    contact.normal = surface.normal(contact.held);
  }
  surface_with_tools(state, surface);
}

void meet_appeared(HapticState& state, DeformedSurface& surface) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    const ToolState& tool = state.tools[i];
    if (!tool.engaged || !tool.appeared) continue;
    const int first = state.contact_count;
    Vec3 way_out = Vec3::Zero();
    for (std::size_t p = 0; p < tool.now.size(); ++p) {
      const auto inside = surface.immersion(tool.now[p], kDeepestAppearance_m);
      if (!inside) continue;
      ToolContact& contact = add_contact(state, static_cast<std::int32_t>(i), static_cast<std::int32_t>(p));
      contact.held = inside->nearest;
      contact.normal = surface.normal(contact.held);
      contact.sunken_m = depth_of(state, contact, surface);
      way_out += contact.normal;
    }
    int index = 0;
    drop_contacts(state, [&](const ToolContact& contact) {
      return index++ >= first && (contact.normal.dot(way_out) <= 0 || contact.sunken_m <= 0);
    });
  }
}

void find_contacts(HapticState& state, DeformedSurface& surface) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    ToolState& tool = state.tools[i];
    if (!tool.engaged) continue;
    for (std::size_t p = 0; p < tool.now.size(); ++p) {
      ToolContact* known = contact_of(state, static_cast<std::int32_t>(i), static_cast<std::int32_t>(p));
      if (known && (known->touches() || known->grasped || known->sunken_m > 0)) {
        tool.clearance[p] = 0;
        continue;
      }
      const auto found = look_around(tool, p, surface);
      if (!found) continue;
      if (!known) known = &add_contact(state, static_cast<std::int32_t>(i), static_cast<std::int32_t>(p));
      known->held = *found;
      known->normal = surface.normal(*found);
    }
  }
}

void release_contacts(HapticState& state, std::span<const Vec3> gaps) noexcept {
  std::size_t i = 0;
  drop_contacts(state, [&](const ToolContact& contact) {
    const double open = gaps[i++].dot(contact.normal);
    return !contact.grasped && !contact.touches() && open > kReleaseGap_m;
  });
}

Vec3 free_gap(const HapticState& state, const ToolContact& contact, const DeformedSurface& surface) noexcept {
  const Vec3 offset = contact.grasped ? contact.offset : Vec3::Zero();
  return state.tools[contact.tool].now[contact.point] - surface.rest_position(contact.held) - offset +
         contact.sunken_m * contact.normal;
}

}  // namespace omentum::haptic
