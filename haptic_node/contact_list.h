// What the files that find, follow and lose contacts do to the list of them.
#pragma once

#include "haptic_node/haptic_model.h"

#include <algorithm>

namespace omentum::haptic {

/// Takes contacts out of the list; the others keep their order. `gone` is asked once for each, in order.
template <class Predicate>
void drop_contacts(HapticState& state, Predicate&& gone) {
  const std::span<ToolContact> active = state.active();
  const auto end = std::remove_if(active.begin(), active.end(), gone);
  state.contact_count = static_cast<int>(end - active.begin());
}

/// How deep the tool's point is below its material point, along the normal, m.
inline double depth_of(const HapticState& state, const ToolContact& contact) {
  const Vec3 p = state.tools[contact.tool].now[contact.point] + contact.other_dents;
  return (contact.place.position - p).dot(contact.place.normal);
}

/// There is room for every point of every tool (require_solvable), but not on each of several bodies: then
/// one that only lies near makes room, to be found again. Nothing where all are needed. `place`s are this
/// tick's.
inline ToolContact* add_contact(HapticState& state, std::int32_t tool, std::int32_t point, BodyId body) {
  if (state.contact_count == physics::kMaxContacts) {
    const auto idle = std::ranges::find_if(state.active(), [&](const ToolContact& contact) {
      return !contact.touches() && !contact.grasped && contact.sunken_m == 0 && depth_of(state, contact) <= 0;
    });
    if (idle == state.active().end()) return nullptr;
    *idle = {.tool = tool, .point = point, .body = body};
    return &*idle;
  }
  ToolContact& contact = state.contacts[state.contact_count++];
  contact = {.tool = tool, .point = point, .body = body};
  return &contact;
}

/// The contact holds another material point, or the same one where it is by now.
inline void hold(const SurfacePoint& point, ToolContact& contact, Body& body) {
  contact.held = point;
  body.find_place(point, contact.place);
}

/// A tool's point as the contact sees it: less the depth that is no press.
inline Vec3 at_the_surface(const ToolContact& contact, std::span<const Vec3> points) {
  return points[contact.point] + contact.sunken_m * contact.place.normal;
}

/// The same where the surface that bears all tools' forces is met.
inline Vec3 with_the_others(const ToolContact& contact, std::span<const Vec3> points) {
  return at_the_surface(contact, points) + contact.other_dents;
}

}  // namespace omentum::haptic
