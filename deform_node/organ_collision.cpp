#include "deform_node/organ_collision.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

// A sphere in the densest packing touches twelve others; as many again are near.
constexpr std::size_t kMostOfASphere = 24;

// Of a tick. Each leaves about a third of what was lacking.
constexpr int kRounds = 12;
// A step that was right for the last round is often too long for what it left.
constexpr double kCaution = 0.8;
// A push through all of an organ.
constexpr double kMostScale = 200;
constexpr double kUnnoticed_m_s = 2e-4;

Eigen::AlignedBox3d box_of(const CollisionSphere& sphere) noexcept {
  const Vec3 reach = Vec3::Constant(sphere.radius_m + kNear_m / 2);
  return {sphere.centre - reach, sphere.centre + reach};
}

// What `own` takes of a correction: all against one that does not yield, none if it does not yield itself.
double share_of(const CollisionSphere& own, const CollisionSphere& other) noexcept {
  if (std::isinf(own.mass_kg)) return 0;
  if (std::isinf(other.mass_kg)) return 1;
  const double both_kg = own.mass_kg + other.mass_kg;
  return both_kg > 0 ? other.mass_kg / both_kg : 0.5;
}

}  // namespace

OrganCollision::OrganCollision(const std::vector<OrganModel*>& models) : bodies_(models.size()) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    bodies_[i].model = models[i];
    const std::size_t spheres = models[i]->sizes().spheres;
    bodies_[i].contacts.reserve(kMostOfASphere * spheres);
    bodies_[i].asked.resize(spheres);
    pairs += kMostOfASphere * spheres;
  }
  pairs_.reserve(pairs / 2);
}

bool OrganCollision::run() noexcept {
  if (!gather()) return true;
  const bool complete = collide();
  if (pairs_.empty()) {
    steepest_ = kMostScale;
    return complete;
  }
  share_out();
  part();
  return complete;
}

// Whether there are two at least that could meet.
bool OrganCollision::gather() noexcept {
  if (bodies_.size() < 2) return false;
  int bodies = 0;
  for (Body& body : bodies_) {
    body.spheres = body.model->collidable();
    body.contacts.clear();
    body.box.setEmpty();
    body.yields = false;
    for (const CollisionSphere& sphere : body.spheres) {
      body.box.extend(box_of(sphere));
      body.yields |= std::isfinite(sphere.mass_kg);
    }
    std::ranges::fill(body.asked, 0.0);
    if (!body.spheres.empty()) ++bodies;
  }
  return bodies > 1;
}

bool OrganCollision::collide() noexcept {
  pairs_.clear();
  bool complete = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((bodies_[i].yields || bodies_[j].yields) && bodies_[i].box.intersects(bodies_[j].box))
        complete &= collide(bodies_[i], bodies_[j]);
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
      if (!(depth_m > -kNear_m) || (std::isinf(a.mass_kg) && std::isinf(b.mass_kg))) continue;
      // of two with one centre neither way is the right one, but both need the same
      const Vec3 normal = distance_m > 0 ? Vec3(way / distance_m) : Vec3::UnitZ();
      if (one.contacts.size() == one.contacts.capacity() ||
          other.contacts.size() == other.contacts.capacity() || pairs_.size() == pairs_.capacity()) {
        complete = false;
        continue;
      }
      const double share_of_one = share_of(a, b), share_of_other = share_of(b, a);
      pairs_.push_back({.one = &one,
                        .other = &other,
                        .at_one = one.contacts.size(),
                        .at_other = other.contacts.size(),
                        .share_of_one = share_of_one,
                        .share_of_other = share_of_other,
                        .weight_kg = std::isinf(a.mass_kg) ? b.mass_kg : share_of_one * a.mass_kg});
      one.contacts.push_back({static_cast<std::int32_t>(i), normal, depth_m, b.velocity, share_of_one});
      other.contacts.push_back({static_cast<std::int32_t>(j), -normal, depth_m, a.velocity, share_of_other});
      one.asked[i] += share_of_one, other.asked[j] += share_of_other;
    }
  }
  return complete;
}

// All that a sphere meets corrects it together: no contact's two sides part by more than it asks for. Both by
// the same number, or momentum would not stay.
void OrganCollision::share_out() noexcept {
  for (Pair& pair : pairs_) {
    const auto asked = [](const Body& body, std::size_t contact) {
      return body.asked[static_cast<std::size_t>(body.contacts[contact].sphere)];
    };
    const double sum = asked(*pair.one, pair.at_one) + asked(*pair.other, pair.at_other);
    pair.share_of_one /= sum;
    pair.share_of_other /= sum;
    pair.weight_kg /= sum;
  }
}

// Steepest descent with a step that was right for the round before (Barzilai and Borwein, 1988, IMA J. Numer.
// Anal. 8), but no longer than was right for the stiffest push since organs met: the rounds may end at any,
// and with a step that grows again what rests would shake each time that it is too long.
void OrganCollision::part() noexcept {
  for (int round = 0; round < kRounds; ++round) {
    double before = 0, after = 0, weight_kg = 0;
    for (Pair& pair : pairs_) {
      refresh(pair);
      before += pair.weight_kg * pair.push_m_s * pair.push_m_s;
      weight_kg += pair.weight_kg;
    }
    // once in any case: who is met looks ahead in the next round
    if (round > 0 && before <= weight_kg * kUnnoticed_m_s * kUnnoticed_m_s) return;
    respond();
    for (Pair& pair : pairs_) after += pair.weight_kg * pair.push_m_s * lacking(pair);
    const double done = before > 0 ? 1 - after / before : 0, right = done > 0 ? scale_ / done : 1;
    steepest_ = std::clamp(right, 1.0, steepest_);
    scale_ = kCaution * std::clamp(right, 1.0, steepest_);
  }
}

// Its contacts say how fast both spheres are by now, and what is left to do: tissue pushes, never pulls.
void OrganCollision::refresh(Pair& pair) noexcept {
  OrganContact &of_one = pair.one->contacts[pair.at_one], &of_other = pair.other->contacts[pair.at_other];
  of_one.velocity = pair.other->velocity(of_other.sphere);
  of_other.velocity = pair.one->velocity(of_one.sphere);
  pair.push_m_s = std::max(lacking(pair), -pair.pushed / scale_);
  pair.pushed += scale_ * pair.push_m_s;
  of_one.push_m_s = of_other.push_m_s = pair.push_m_s;
  of_one.share = scale_ * pair.share_of_one;
  of_other.share = scale_ * pair.share_of_other;
}

double OrganCollision::lacking(const Pair& pair) const noexcept {
  const std::int32_t of_other = pair.other->contacts[pair.at_other].sphere;
  OrganContact of_one = pair.one->contacts[pair.at_one];
  of_one.velocity = pair.other->velocity(of_other);
  return lacking_speed(of_one, pair.one->velocity(of_one.sphere));
}

void OrganCollision::respond() noexcept {
  for (Body& body : bodies_)
    if (!body.contacts.empty()) body.model->respond(body.contacts);
  for (Body& body : bodies_)
    if (!body.contacts.empty()) body.spheres = body.model->collidable();
}

}  // namespace omentum::deform
