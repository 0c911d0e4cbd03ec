#include "haptic_node/body_change.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/enclosed_tool.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"
#include "transport/messages.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// The same material point of another model of the tissue: among the same nodes of the mesh file, or, where
// these are not known or that triangle is gone, at the same place without forces.
std::optional<SurfacePoint> same_point(const ToolContact& contact, const Body& old, Body& body) {
  const PointNodes& at = contact.place.nodes;
  const std::span<const std::uint32_t> numbers = old.origin().file_node;
  std::array<std::uint32_t, 3> file_nodes{};
  if (at.count == 3 && !numbers.empty()) {
    for (std::size_t v = 0; v < file_nodes.size(); ++v)
      file_nodes[v] = numbers[static_cast<std::size_t>(at.node[v])];
    if (auto same = body.point_among(file_nodes, at.weight)) return same;
  }
  return body.nearest_at_rest(contact.place.rest, Body::kReach_m);
}

// Contacts at `place` go over to `body`; without one, or where it has no such point, they end, and where
// their points are is asked a tick later, as in leave_astray.
void move_contacts(BodyId place, const Body* old, Body* body, HapticState& state) {
  std::array<bool, physics::kMaxContacts> ended{};
  for (std::size_t i = 0; i < state.active().size(); ++i) {
    ToolContact& contact = state.contacts[i];
    if (contact.body != place) continue;
    const auto same = old && body ? same_point(contact, *old, *body) : std::nullopt;
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
    if (!state.tools[t].grasping || std::ranges::any_of(state.active(), holds)) continue;
    state.tools[t].grasping = false;
    ++state.tools[t].grasps.lost;
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
        memory = {.adrift = true, .ask_in = 1, .enclosed = memory.enclosed || tissue_comes_back(state)};
      } else if (!memory.adrift && memory.ask_in == 0 && !holds_contact(state, place, t, p)) {
        memory.ask_in = 1;
        memory.ask_m = Body::kReach_m;
      }
    }
  }
}

// What the contacts of each tool hold at `place`, as its body stands, J.
std::array<double, msg::MAX_TOOLS> held_at(BodyId place, Body& body, HapticState& state) {
  std::array<double, msg::MAX_TOOLS> held_j{};
  for (ToolContact& contact : state.active()) {
    if (contact.body != place || !contact.touches()) continue;
    const Place now = body.place_of(contact.held);
    held_j[static_cast<std::size_t>(contact.tool)] += 0.5 * contact.force.dot(now.position - now.rest);
  }
  return held_j;
}

// Under the same forces another model holds more or less, which nobody did: an account goes along, as far as
// that gives the hand nothing in sum.
void settle(std::span<const double> before_j, std::span<const double> after_j, HapticState& state) {
  for (std::size_t t = 0; t < state.energies.size(); ++t) {
    ContactEnergy& energy = state.energies[t];
    const double more_j = after_j[t] - before_j[t];
    if (more_j == 0 || energy.stored_j < kNoEnergy_j) continue;
    energy.stored_j = std::max(energy.stored_j + more_j, 0.0);
    energy.account_j += state.tools[t].changes.credit(energy.share * more_j);
  }
}

void take_over(BodyId place, Body& old, Body& body, HapticState& state) {
  const auto before_j = held_at(place, old, state);
  move_contacts(place, &old, &body, state);
  forget_node_forces(place, state);
  load(place, body, state);
  body.continue_from(old, state.now_ns);
  if (!std::ranges::any_of(state.tools, &ToolState::let_go))
    settle(before_j, held_at(place, body, state), state);
}

void take_in(BodyId place, std::unique_ptr<Body>& handed, HapticState& state, Bodies& bodies) {
  Body* const body = handed.get();
  bodies.exchange(place, handed);
  Body* const old = handed.get();
  forget_distances(place, old != nullptr, state);
  if (old && body) {
    take_over(place, *old, *body, state);
  } else {
    move_contacts(place, old, body, state);
    forget_node_forces(place, state);
    if (body) load(place, *body, state), body->go_on(state.now_ns);
  }
  if (body) measure_other_tools(place, *body, state);
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
