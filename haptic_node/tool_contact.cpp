#include "haptic_node/tool_contact.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/enclosed_tool.h"
#include "haptic_node/jaws.h"
#include "haptic_node/lost_contact.h"
#include "haptic_node/other_tools.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// A point this near to the surface is in the contact problem, with an open gap, m: found only when it is
// inside, it took over its neighbours' load in one tick (0.5 N in a dent of 8 mm). An open contact is kept up
// to kReleaseGap_m, apart from it so that none comes and goes.
constexpr double kNear_m = 1e-3;
constexpr double kReleaseGap_m = 1.5e-3;

// An open contact is solved for when its gap is below so many of the tools' longest way in this tick, and
// this, m: tissue goes hardly farther than what presses it.
constexpr double kClosingWays = 3;
constexpr double kRestless_m = 5e-5;

// How far a point without room is looked around, m: this many times the room it had, and at least kNear_m. A
// point that has 1 mm of room needs no look for the next 40 ticks at 25 mm/s.
constexpr double kArmGrowth = 4;
// Rounding of positions, m.
constexpr double kHair_m = 1e-6;

// Farther from W's origin than any scene, m: floats there no longer tell a tenth of a millimetre.
constexpr double kFarthest_m = 1000;

// How far jaws slip along what they hold, m: half of their length. What came back farther away let go
// meanwhile.
constexpr double kMostSlip_m = 0.01;

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

// Of each of a tool's points with one body, if it has one.
std::array<ToolContact*, physics::kMaxContacts> contacts_of(HapticState& state, std::size_t tool,
                                                            BodyId body) {
  std::array<ToolContact*, physics::kMaxContacts> contacts;
  std::fill_n(contacts.begin(), state.tools[tool].now.size(), nullptr);
  for (ToolContact& contact : state.active()) {
    if (contact.tool == static_cast<std::int32_t>(tool) && contact.body == body)
      contacts[contact.point] = &contact;
  }
  return contacts;
}

// How far at most the last forces moved what was near the tools before, and what was not, m.
struct SurfaceMotion {
  double known, entered;
};

// The surface point that tool point p met on its way, if any. Whoever has more room than tool and surface
// moved together met nothing.
std::optional<SurfacePoint> look_around(ToolState& tool, std::size_t p, const SurfaceMotion& motion,
                                        PointMemory& memory, Body& body) {
  double& room = memory.clearance_m;
  const double before = room, way = (tool.now[p] - tool.before[p]).norm() + kHair_m;
  room = std::min(room - way - motion.known, Body::kReach_m - way - motion.entered);
  if (room > tool.others_m) return std::nullopt;
  const double near = kNear_m + tool.others_m;
  const double arm = std::clamp(kArmGrowth * before, near, Body::kReach_m + tool.others_m);
  const Encounter met = body.meet(tool.before[p], tool.now[p], arm, !memory.adrift);
  if (met.touched || met.nearest) memory.adrift = false;
  room = met.touched ? 0 : met.clearance_m;
  return met.touched || met.clearance_m > near ? met.touched : met.nearest;
}

void go_to(const ToolModel& model, const ToolInput& input, ToolState& tool) {
  tool.frame = model.trocar ? through_trocar(input.frame, *model.trocar) : input.frame;
  tool.grip_before = tool.grip;
  tool.grip = std::clamp(input.grip, 0.0, kWidest_rad);
  std::swap(tool.before, tool.now);
  for (std::size_t p = 0; p < tool.now.size(); ++p)
    tool.now[p] = to_world(tool.frame, at_opening(model, model.points[p], tool.grip));
}

// Where its points are is asked now; a tick later where the surface is still dented by the tool's own force:
// there it would seem to be outside.
void appear(const HapticState& state, ToolState& tool) {
  tool.before = tool.now;
  tool.grip_before = tool.grip;
  PointMemory unknown;
  unknown.adrift = true;
  unknown.ask_in = tool.let_go ? 2 : 1;
  unknown.enclosed = tissue_comes_back(state);
  std::ranges::fill(tool.memories, unknown);
}

// Jaws of which nothing is heard for a moment stand where they were: no way, no work.
void stand_still(ToolState& tool) {
  tool.before = tool.now;
  tool.grip_before = tool.grip;
  tool.tip_way = Vec3::Zero();
  tool.let_go = false;
}

void let_go(HapticState& state, std::int32_t tool) {
  state.tools[tool].grasps.lost += state.tools[tool].grasping;
  end_grasp(state, tool);
  drop_contacts(state, [&](const ToolContact& contact) { return contact.tool == tool; });
}

// What a hand did while it was not heard moved no tissue, since its force had faded: jaws slip along what
// they hold by that way, and what they hold feels no step. False: that would be farther than a slip.
bool slip_by_way(HapticState& state, std::int32_t index) {
  const ToolState& tool = state.tools[index];
  const auto way = [&](const ToolContact& c) { return Vec3(tool.now[c.point] - tool.before[c.point]); };
  const auto holds = [&](const ToolContact& c) { return c.tool == index && c.grasped; };
  if (std::ranges::any_of(state.active(), [&](const ToolContact& contact) {
        return holds(contact) && !(way(contact).norm() <= kMostSlip_m);
      }))
    return false;
  for (ToolContact& contact : state.active())
    if (holds(contact)) contact.offset += way(contact);
  drop_contacts(state, [&](const ToolContact& c) { return c.tool == index && !c.grasped; });
  return true;
}

// A tool that did not come here by moving. `holds_on`: its jaws may hold on to what they held.
void arrive(HapticState& state, std::int32_t index, bool holds_on) {
  ToolState& tool = state.tools[index];
  if (!holds_on || !slip_by_way(state, index)) let_go(state, index);
  appear(state, tool);
  for (const ToolContact& contact : state.active())
    if (contact.tool == index) tool.memory(contact.body, static_cast<std::size_t>(contact.point)) = {};
}

// The contact of a tool's point with what it met; deeper than it came in this tick is nobody's press.
void begin_contact(const SurfacePoint& met, const HapticState& state, ToolContact& contact, Body& body) {
  const ToolState& tool = state.tools[contact.tool];
  hold(met, contact, body);
  const double way = (tool.now[contact.point] - tool.before[contact.point]).norm() + kHair_m;
  contact.sunken_m = std::max(0.0, depth_of(state, contact) - way);
}

void find_contacts_with(BodyId id, Body& body, std::size_t tool_index, HapticState& state) {
  ToolState& tool = state.tools[tool_index];
  const auto contacts = contacts_of(state, tool_index, id);
  const SurfaceMotion motion{body.known_motion(), body.entered_motion()};
  for (std::size_t p = 0; p < tool.now.size(); ++p) {
    PointMemory& memory = tool.memory(id, p);
    if (memory.ask_in > 0) continue;  // meet_appeared looks for it
    const auto point = static_cast<std::int32_t>(p), of_tool = static_cast<std::int32_t>(tool_index);
    ToolContact* known = contacts[p];
    // another point's may have taken its place in a full list
    if (known && (known->point != point || known->tool != of_tool || known->body != id)) known = nullptr;
    if (known && (known->touches() || known->grasped || known->sunken_m > 0)) {
      memory.clearance_m = 0;
      note_outside(state, memory);  // what tissue came back around has no contact
      continue;
    }
    const auto found = look_around(tool, p, motion, memory, body);
    if (!memory.adrift) note_outside(state, memory);
    if (!found) continue;
    if (known) {
      const bool alone = known->other_dents.isZero(0);
      hold(alone ? *found : body.slide(*found, with_the_others(*known, tool.now)), *known, body);
    } else if (ToolContact* contact = add_contact(state, of_tool, point, id)) {
      begin_contact(*found, state, *contact, body);
    } else {
      // who finds no room in the list and is inside feels nothing until it was outside
      const Place met = body.place_of(*found);
      memory.adrift = (met.position - tool.now[p]).dot(met.normal) > 0;
    }
  }
}

// The material point that a contact goes on to hold.
SurfacePoint moved_on(const HapticModel& model, const ToolState& tool, const ToolContact& contact,
                      Body& body) {
  if (contact.grasped) return contact.held;
  if (model.friction == 0 || !contact.touches())
    return body.slide(contact.held, with_the_others(contact, tool.now));
  // friction is back inside its cone where the tool was; from there it moves on
  return contact.sliding ? body.slide(contact.held, with_the_others(contact, tool.before)) : contact.held;
}

}  // namespace

bool is_sound(const ToolInput& input) noexcept {
  return input.frame.p_WT.allFinite() && input.frame.p_WT.cwiseAbs().maxCoeff() <= kFarthest_m &&
         input.frame.q_WT.coeffs().allFinite() && std::isfinite(input.grip) &&
         std::isfinite(1 / input.max_stiffness_n_m) && input.max_stiffness_n_m > 0;
}

void let_go_of_everything(HapticState& state) noexcept {
  state.contact_count = state.node_force_count = 0;
  std::ranges::fill(state.energies, ContactEnergy{});
  for (ToolState& tool : state.tools) tool.engaged = tool.grasping = false;
}

void place_tools(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                 Bodies& bodies) noexcept {
  ++state.ticks;
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    ToolState& tool = state.tools[i];
    const ToolInput& input = inputs[i];
    if (input.silent && tool.engaged && tool.grasping) {
      stand_still(tool);
      continue;
    }
    const bool holds_on = input.heard_again && tool.engaged && tool.grasping && is_sound(input);
    const bool engaged = holds_on || (input.engaged && is_sound(input));
    const bool moved_here = engaged && tool.engaged && !input.relocated;
    tool.let_go = !moved_here && state.energies[i].stored_j > 0;
    if (!moved_here && !holds_on) let_go(state, index);
    tool.engaged = engaged;
    if (!engaged) continue;
    const Vec3 tip = tool.frame.p_WT;
    go_to(model.tools[i], input, tool);
    tool.tip_way = moved_here ? Vec3(tool.frame.p_WT - tip) : Vec3::Zero();
    if (!moved_here) arrive(state, index, holds_on);
    if (model.tools[i].grasps) follow_grip(model, state, index, input.grip, bodies);
  }
}

void evaluate_neighbourhood(HapticState& state, Bodies& bodies) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    const ToolState& tool = state.tools[i];
    if (!tool.engaged || tool.now.empty()) continue;  // an endoscope has nothing to touch with
    Region region = path_of(tool);
    look_for_other_tools(region, static_cast<std::int32_t>(i), state, bodies);
    region.low.array() -= tool.others_m;
    region.high.array() += tool.others_m;
    bodies.for_each([&](BodyId, Body& body) { body.evaluate(region); });
  }
}

void follow_surface(const HapticModel& model, HapticState& state, Bodies& bodies) noexcept {
  for (ToolContact& contact : state.active()) {
    Body& body = bodies[contact.body];
    hold(moved_on(model, state.tools[contact.tool], contact, body), contact, body);
  }
  surface_with_tools(state, bodies);
}

void find_contacts(HapticState& state, Bodies& bodies) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    if (!state.tools[i].engaged) continue;
    bodies.for_each([&](BodyId id, Body& body) {
      if (body.is_for(i)) find_contacts_with(id, body, i, state);
    });
  }
}

int set_open_aside(HapticState& state) noexcept {
  double squared_way = 0;
  for (const ToolState& tool : state.tools) {
    if (!tool.engaged) continue;
    for (std::size_t p = 0; p < tool.now.size(); ++p)
      squared_way = std::max(squared_way, (tool.now[p] - tool.before[p]).squaredNorm());
  }
  const double open_m = kClosingWays * std::sqrt(squared_way) + kRestless_m;
  const auto begin = state.contacts.begin();
  int count = 0;
  for (int i = 0; i < state.contact_count; ++i) {
    const ToolContact& contact = state.contacts[i];
    const bool holds = contact.touches() || contact.grasped || contact.sunken_m > 0;
    if (!holds && depth_of(state, contact) < -open_m) continue;
    if (i > count) std::rotate(begin + count, begin + i, begin + i + 1);
    ++count;
  }
  return count;
}

void release_contacts(HapticState& state, std::span<const Vec3> gaps) noexcept {
  std::size_t i = 0;
  drop_contacts(state, [&](const ToolContact& contact) {
    const double open = gaps[i++].dot(contact.place.normal);
    return !contact.grasped && !contact.touches() && contact.sunken_m == 0 &&
           open > kReleaseGap_m + state.tools[contact.tool].others_m;
  });
}

Vec3 free_gap(const HapticState& state, const ToolContact& contact) noexcept {
  const Vec3 offset = contact.grasped ? contact.offset : Vec3::Zero();
  return state.tools[contact.tool].now[contact.point] - contact.place.rest - offset +
         contact.sunken_m * contact.place.normal;
}

}  // namespace omentum::haptic
