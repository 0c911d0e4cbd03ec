#include "haptic_node/body_change.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"

namespace omentum::haptic {
namespace {

// Contacts at `place` go over to `body`; without one, or where it has no such point, they end.
void move_contacts(BodyId place, Body* body, HapticState& state) {
  drop_contacts(state, [&](ToolContact& contact) {
    if (contact.body != place) return false;
    const auto same = body ? body->nearest_at_rest(contact.place.rest, Body::kReach_m) : std::nullopt;
    if (same)
      hold(*same, contact, *body);
    else
      state.tools[contact.tool].let_go |= contact.touches();
    return !same;
  });
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

// Points outside of what stood there are outside of what replaces it, nobody knows how far; of a body that
// was not there nothing is known.
void forget_distances(BodyId place, bool replaced, HapticState& state) {
  for (ToolState& tool : state.tools) {
    for (std::size_t p = 0; p < tool.now.size(); ++p) {
      PointMemory& memory = tool.memory(place, p);
      memory.clearance_m = 0;
      if (!replaced) memory = {.adrift = true, .ask_in = 1};
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
  if (body) load(place, *body, state);
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
  if (any) measure_other_tools(state, work.bodies);
}

}  // namespace omentum::haptic
