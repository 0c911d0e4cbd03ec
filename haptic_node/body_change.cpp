#include "haptic_node/body_change.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// Contacts at `place` go over to `body`; without one, or where it has no such point, they end, and where
// their points are is asked a tick later, as in leave_astray.
void move_contacts(BodyId place, Body* body, HapticState& state) {
  std::array<bool, physics::kMaxContacts> ended{};
  for (std::size_t i = 0; i < state.active().size(); ++i) {
    ToolContact& contact = state.contacts[i];
    if (contact.body != place) continue;
    const auto same = body ? body->nearest_at_rest(contact.place.rest, Body::kReach_m) : std::nullopt;
    ended[i] = !same;
    if (same) {
      hold(*same, contact, *body);
      continue;
    }
    ToolState& tool = state.tools[contact.tool];
    PointMemory& memory = tool.memory(place, static_cast<std::size_t>(contact.point));
    memory.ask_in = 2;
    memory.ask_m = kDeepestAppearance_m;
    memory.way_out = contact.place.normal;
    tool.let_go |= contact.touches();
  }
  std::size_t i = 0;
  drop_contacts(state, [&](const ToolContact&) { return ended[i++]; });
}

// Jaws that hold nothing any more.
void end_empty_grasps(HapticState& state) {
  for (std::size_t t = 0; t < state.tools.size(); ++t) {
    const auto holds = [t](const ToolContact& contact) {
      return contact.grasped && contact.tool == static_cast<std::int32_t>(t);
    };
    state.tools[t].grasping &= std::ranges::any_of(state.active(), holds);
  }
}

// The body takes over the forces of its contacts.
void load(BodyId place, Body& body, HapticState& state) {
  for (const ToolContact& contact : state.active()) {
    if (contact.body == place && contact.touches()) share_force(state, contact);
  }
  propose_forces(state, place, body);
  body.accept();
}

void forget_node_forces(BodyId place, HapticState& state) {
  const auto begin = state.node_forces.begin(), end = begin + state.node_force_count;
  const auto left = std::remove_if(begin, end, [&](const NodeForce& entry) { return entry.body == place; });
  state.node_force_count = static_cast<int>(left - begin);
}

bool holds_contact(const HapticState& state, BodyId place, std::size_t tool, std::size_t point) {
  return std::ranges::any_of(state.active(), [&](const ToolContact& contact) {
    return contact.body == place && contact.tool == static_cast<std::int32_t>(tool) &&
           contact.point == static_cast<std::int32_t>(point);
  });
}

// Of a body that was not there nothing is known. Points outside of what stood there are outside of what
// replaces it, or a little inside, as the two differ.
void forget_distances(BodyId place, bool replaced, HapticState& state) {
  for (std::size_t t = 0; t < state.tools.size(); ++t) {
    ToolState& tool = state.tools[t];
    for (std::size_t p = 0; p < tool.now.size(); ++p) {
      PointMemory& memory = tool.memory(place, p);
      memory.clearance_m = 0;
      if (!replaced) {
        memory = {.adrift = true, .ask_in = 1};
      } else if (!memory.adrift && memory.ask_in == 0 && !holds_contact(state, place, t, p)) {
        memory.ask_in = 1;
        memory.ask_m = Body::kReach_m;
      }
    }
  }
}

void take_in(BodyId place, std::unique_ptr<Body>& handed, HapticState& state, Bodies& bodies) {
  Body* const body = handed.get();
  bodies.exchange(place, handed);
  const bool replaced = handed != nullptr;
  move_contacts(place, body, state);
  forget_node_forces(place, state);
  forget_distances(place, replaced, state);
  if (!body) return;
  load(place, *body, state);
  measure_other_tools(place, *body, state);
}

}  // namespace

void take_in_bodies(HapticState& state, HapticWorkspace& work) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < work.doors.size(); ++i) {
    BodyDoor& door = work.doors[i];
    if (!door.fetch()) continue;
    take_in(BodyId(i), door.value(), state, work.bodies);
    any = true;
  }
  if (any) end_empty_grasps(state);
}

}  // namespace omentum::haptic
