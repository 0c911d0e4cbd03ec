#include "haptic_node/lost_contact.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/enclosed_tool.h"
#include "haptic_node/jaws.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace omentum::haptic {
namespace {

constexpr double kUnknownDepth_m = std::numeric_limits<double>::infinity();
// How far along the surface a contact that presses may be from its tool's point, m: a quarter of what the
// place was moved (tissue under a deep press also moves sideways), between these. The upper bound is what a
// tool may be away from all tissue and feel something.
constexpr double kAstrayPart = 0.25;
constexpr double kAstrayLeast_m = 2e-3;
constexpr double kAstrayMost_m = 4.5e-3;
// A tool beyond the far side that has less than this of the tissue before it is through: tissue squeezed to a
// half is far beyond what a linear model can say, and it would draw the far side along for ever.
constexpr double kThrough = 0.5;
// Normals of two contacts of one tool that point against each other, as a cosine, and how far beyond the
// tool's middle, in its radii, a contact pushes what should lie in the tissue: tissue that holds a tip from
// both sides lies around it, not in it.
constexpr double kOpposed = -0.5;
constexpr double kBehind = 0.6;
// A contact that holds a depth without force is asked where it is once in so many ticks.
constexpr std::uint64_t kAskPeriod = 64;

// The contact's way from its material point to its tool's point of the last tick, whose forces made the
// surface: along the surface it should be none.
bool is_astray(const ToolState& tool, const ToolContact& contact, Body& body) {
  const Vec3 held = body.position(contact.held);
  const Vec3 gap = with_the_others(contact, tool.before) - held;
  const double squared_along = (gap - gap.dot(contact.place.normal) * contact.place.normal).squaredNorm();
  if (squared_along <= kAstrayLeast_m * kAstrayLeast_m) return false;
  const double moved = (held - contact.place.rest).norm();
  return std::sqrt(squared_along) > std::clamp(kAstrayPart * moved, kAstrayLeast_m, kAstrayMost_m);
}

// Whether the tool's point has gone through the organ: beyond where its far side is at rest, while most of
// the tissue before it is squeezed away. A lobe that bends away goes beyond as well, but keeps its thickness.
bool is_through(const ToolState& tool, const ToolContact& contact, Body& body) {
  return body.tissue_ahead(contact.held, at_the_surface(contact, tool.before)) < kThrough;
}

// Whether a body pushes two points of one tool against each other.
bool are_opposed(const ToolContact& one, const ToolContact& other) {
  return other.tool == one.tool && other.body == one.body && other.touches() &&
         other.place.normal.dot(one.place.normal) < kOpposed;
}

bool is_opposed(const HapticState& state, const ToolContact& contact) {
  return std::ranges::any_of(state.active(),
                             [&](const ToolContact& other) { return are_opposed(contact, other); });
}

// Whether the tissue at a contact lies between two jaws, and is pressed from both sides.
bool is_between_jaws(const ToolModel& model, const HapticState& state, const ToolContact& contact) {
  const ToolState& tool = state.tools[contact.tool];
  const auto jaw = [&](const ToolContact& c) { return jaw_of(model, model.points[c.point]); };
  return (tool.opened || tool.grasping) && std::ranges::any_of(state.active(), [&](const ToolContact& other) {
           return are_opposed(contact, other) && jaw(contact) * jaw(other) < 0;
         });
}

// Whether the tissue that touches the tool's point would have the tool's middle inside: a side that was drawn
// through the other one.
bool is_behind(const ToolState& tool, const ToolContact& contact) {
  const double points = static_cast<double>(tool.before.size());
  const Vec3 middle = std::accumulate(tool.before.begin(), tool.before.end(), Vec3(0, 0, 0)) / points;
  double radius_m = 0;
  for (const Vec3& p : tool.before) radius_m = std::max(radius_m, (p - middle).norm());
  return (tool.before[contact.point] - middle).dot(contact.place.normal) > kBehind * radius_m;
}

// Whether a contact that presses is no longer on its own side of the organ.
bool went_through(const ToolModel& model, const HapticState& state, const ToolContact& contact, Body& body) {
  const ToolState& tool = state.tools[contact.tool];
  if (is_between_jaws(model, state, contact)) return false;
  return is_through(tool, contact, body) || (is_opposed(state, contact) && is_behind(tool, contact));
}

// What of a tool's depth is no press: as if the tool had moved out, along the mean normal of its points
// inside, until its deepest one is at the surface. So it then feels deeper tissue as it would feel it from
// outside. A point never holds less than its own depth, nor more than it held before.
template <class Predicate>
void sink(HapticState& state, Predicate&& belongs) {
  double deepest_m = 0;
  Vec3 out = Vec3::Zero();
  for (const ToolContact& contact : state.active()) {
    if (!belongs(contact)) continue;
    deepest_m = std::max(deepest_m, depth_of(state, contact));
    out += contact.place.normal;
  }
  out.normalize();
  for (ToolContact& contact : state.active()) {
    if (!belongs(contact)) continue;
    const double own_m = std::max(0.0, depth_of(state, contact));
    contact.sunken_m = std::min(contact.sunken_m, std::max(own_m, deepest_m * contact.place.normal.dot(out)));
  }
}

// Bit t: tool t presses.
std::uint32_t pressing_tools(const HapticState& state) {
  std::uint32_t tools = 0;
  for (const ToolContact& contact : state.active()) tools |= std::uint32_t{contact.touches()} << contact.tool;
  return tools;
}

// The contacts from `first` on are what a tool has just been found inside a body with: those that would leave
// through another side than most are none.
void keep_one_way_out(const Vec3& way_out, int first, HapticState& state) {
  int index = 0;
  drop_contacts(state, [&](const ToolContact& contact) {
    return index++ >= first && (contact.place.normal.dot(way_out) <= 0 || depth_of(state, contact) <= 0);
  });
  sink(state, [](const ToolContact& contact) { return contact.sunken_m == kUnknownDepth_m; });
}

void meet_appeared_in(BodyId id, std::size_t tool_index, HapticState& state, Bodies& bodies) {
  ToolState& tool = state.tools[tool_index];
  Body& body = bodies[id];
  const int first = state.contact_count;
  Vec3 way_out = Vec3::Zero();
  for (std::size_t p = 0; p < tool.now.size(); ++p) {
    PointMemory& memory = tool.memory(id, p);
    if (memory.ask_in == 0 || --memory.ask_in > 0) continue;
    const auto inside = body.immersion(tool.now[p], memory.ask_m);
    memory.adrift = inside.has_value();
    if (!inside) note_outside(state, memory);
    if (!inside || memory.enclosed || body.place_of(inside->nearest).normal.dot(memory.way_out) < 0) continue;
    // what finds no room in the list stays adrift
    if (state.contact_count == physics::kMaxContacts) continue;
    ToolContact& contact =
        *add_contact(state, static_cast<std::int32_t>(tool_index), static_cast<std::int32_t>(p), id);
    hold(inside->nearest, contact, body);
    contact.sunken_m = kUnknownDepth_m;
    way_out += contact.place.normal;
  }
  if (state.contact_count > first) keep_one_way_out(way_out, first, state);
}

}  // namespace

void leave_astray(const HapticModel& model, HapticState& state, Bodies& bodies) noexcept {
  const std::uint32_t pressing = pressing_tools(state);
  std::uint64_t turn = state.ticks;
  std::array<bool, physics::kMaxContacts> left{};
  for (std::size_t i = 0; i < state.active().size(); ++i) {
    const ToolContact& contact = state.contacts[i];
    if (contact.grasped) continue;
    ToolState& tool = state.tools[contact.tool];
    Body& body = bodies[contact.body];
    const bool idle = contact.sunken_m > 0 && (pressing >> contact.tool & 1) == 0;
    const bool through = contact.touches() && went_through(model.tools[contact.tool], state, contact, body);
    const bool to_ask = is_astray(tool, contact, body) || (idle && ++turn % kAskPeriod == 0);
    if (!through && !to_ask) continue;
    left[i] = true;
    PointMemory& memory = tool.memory(contact.body, static_cast<std::size_t>(contact.point));
    memory.adrift = through;
    memory.ask_m = kDeepestAppearance_m;
    memory.ask_in = !through && (contact.touches() || contact.sunken_m > 0) ? 2 : 0;
    memory.way_out = contact.place.normal;
    tool.let_go |= contact.touches();
  }
  std::size_t i = 0;
  drop_contacts(state, [&](const ToolContact&) { return left[i++]; });
}

void surface_with_tools(HapticState& state, Bodies& bodies) noexcept {
  const std::uint32_t pressing = pressing_tools(state);
  std::uint32_t sunk = 0;
  for (const ToolContact& contact : state.active())
    sunk |= std::uint32_t{contact.sunken_m > 0} << contact.tool;
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    if (((sunk & ~pressing) >> i & 1) == 0) continue;
    bodies.for_each([&](BodyId id, Body&) {
      sink(state, [&](const ToolContact& contact) {
        return contact.tool == static_cast<std::int32_t>(i) && contact.body == id && contact.sunken_m > 0;
      });
    });
  }
}

void meet_appeared(HapticState& state, Bodies& bodies) noexcept {
  for (std::size_t i = 0; i < state.tools.size(); ++i) {
    if (!state.tools[i].engaged) continue;
    bodies.for_each([&](BodyId id, Body& body) {
      if (body.is_for(i)) meet_appeared_in(id, i, state, bodies);
    });
  }
}

}  // namespace omentum::haptic
