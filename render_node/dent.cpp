#include "render_node/dent.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

// The contact at rest.
struct Contact {
  Vec3f rest = Vec3f::Zero(), position = Vec3f::Zero(), outward = Vec3f::Zero();
};

std::optional<Contact> contact_of(const OrganSkin& skin, std::span<const PressedNode> pressed) {
  Contact contact;
  float total_n = 0;
  for (const auto& [node, force_n] : pressed) {
    total_n += force_n;
    contact.rest += force_n * skin.rest(node);
    contact.position += force_n * skin.position(node);
    contact.outward += force_n * skin.rest_normal(node);
  }
  if (!(total_n > 0) || !(contact.outward.norm() > 0)) return std::nullopt;
  contact.rest /= total_n;
  contact.position /= total_n;
  contact.outward.normalize();
  return contact;
}

// The mean displacement of what lies around the contact; none where nothing does.
Vec3f surroundings(const OrganSkin& skin, const Contact& contact) {
  const double radius_m = std::min(kRingRadius_m, kRingRadiusShare * skin.extent_m());
  Vec3f sum = Vec3f::Zero();
  float count = 0;
  for (std::int32_t s = 0; s < skin.node_count(); ++s) {
    const geometry::SurfaceId node(s);
    if (!skin.has(node)) continue;
    const double off_m = std::abs((skin.rest(node) - contact.rest).norm() - radius_m);
    if (off_m > kRingHalfWidth * radius_m || skin.rest_normal(node).dot(contact.outward) <= 0) continue;
    sum += skin.position(node) - skin.rest(node);
    ++count;
  }
  return count > 0 ? Vec3f(sum / count) : Vec3f::Zero();
}

}  // namespace

std::optional<Dent> measure_dent(const OrganSkin& skin, std::span<const PressedNode> pressed) {
  const auto contact = contact_of(skin, pressed);
  if (!contact) return std::nullopt;
  const Vec3f moved = contact->position - contact->rest - surroundings(skin, *contact);
  return Dent{std::max(0.0, -static_cast<double>(moved.dot(contact->outward))), contact->position,
              contact->outward};
}

}  // namespace omentum::render
