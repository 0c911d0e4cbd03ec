#include "deform_node/organ_collision.h"

#include <cmath>

namespace omentum::deform {

namespace {

// A sphere in the densest packing touches twelve others; organs that press into each other have no more.
constexpr std::size_t kMostOfASphere = 12;

Eigen::AlignedBox3d box_of(const CollisionSphere& sphere) noexcept {
  const Vec3 reach = Vec3::Constant(sphere.radius_m);
  return {sphere.centre - reach, sphere.centre + reach};
}

// What `own` takes of a correction: all against one that does not yield, none if it does not yield itself.
double share_of(const CollisionSphere& own, const CollisionSphere& other) noexcept {
  if (std::isinf(own.mass_kg)) return 0;
  if (std::isinf(other.mass_kg)) return 1;
  const double both_kg = own.mass_kg + other.mass_kg;
  return both_kg > 0 ? other.mass_kg / both_kg : 0.5;
}

bool add(std::vector<OrganContact>& contacts, const OrganContact& contact) noexcept {
  if (contacts.size() == contacts.capacity()) return false;
  contacts.push_back(contact);
  return true;
}

}  // namespace

OrganCollision::OrganCollision(const std::vector<OrganModel*>& models) : bodies_(models.size()) {
  for (std::size_t i = 0; i < models.size(); ++i) {
    bodies_[i].model = models[i];
    bodies_[i].contacts.reserve(kMostOfASphere * models[i]->sizes().spheres);
  }
}

bool OrganCollision::run() noexcept {
  if (!gather()) return true;
  const bool complete = collide();
  respond();
  return complete;
}

// Whether there are two at least that could meet.
bool OrganCollision::gather() noexcept {
  int bodies = 0;
  for (Body& body : bodies_) {
    body.spheres = body.model->collidable();
    body.contacts.clear();
    body.box.setEmpty();
    for (const CollisionSphere& sphere : body.spheres) body.box.extend(box_of(sphere));
    if (!body.spheres.empty()) ++bodies;
  }
  return bodies > 1;
}

bool OrganCollision::collide() noexcept {
  bool complete = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (bodies_[i].box.intersects(bodies_[j].box)) complete &= collide(bodies_[i], bodies_[j]);
  return complete;
}

bool OrganCollision::collide(Body& one, Body& other) noexcept {
  bool complete = true;
  for (std::size_t i = 0; i < one.spheres.size(); ++i) {
    const CollisionSphere& a = one.spheres[i];
    if (!other.box.intersects(box_of(a))) continue;
    for (std::size_t j = 0; j < other.spheres.size(); ++j) {
      const CollisionSphere& b = other.spheres[j];
      const Vec3 way = a.centre - b.centre;
      const double distance_m = way.norm(), depth_m = a.radius_m + b.radius_m - distance_m;
      if (!(depth_m > 0)) continue;
      // of two with one centre neither way is the right one, but both need the same
      const Vec3 normal = distance_m > 0 ? Vec3(way / distance_m) : Vec3::UnitZ();
      complete &=
          add(one.contacts, {static_cast<std::int32_t>(i), normal, depth_m, b.velocity, share_of(a, b)});
      complete &=
          add(other.contacts, {static_cast<std::int32_t>(j), -normal, depth_m, a.velocity, share_of(b, a)});
    }
  }
  return complete;
}

void OrganCollision::respond() noexcept {
  for (Body& body : bodies_)
    if (!body.contacts.empty()) body.model->respond(body.contacts);
}

}  // namespace omentum::deform
