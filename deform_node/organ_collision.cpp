#include "deform_node/organ_collision.h"

#include "geometry/across.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace omentum::deform {

namespace {

// A sphere in the densest packing touches twelve others; as many again are near.
constexpr std::size_t kMostOfASphere = 24;

// Of a tick. Each leaves about a third of what was lacking.
constexpr int kRounds = 12;
// A step that was right for the last round is often too long for what it left.
constexpr double kCaution = 0.8;
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

OrganCollision::OrganCollision(const std::vector<OrganModel*>& models, runtime::Crew* crew)
    : crew_(crew == nullptr ? alone_ : *crew), bodies_(models.size()) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    bodies_[i].model = models[i];
    const std::size_t spheres = models[i]->sizes().spheres;
    bodies_[i].contacts.reserve(kMostOfASphere * spheres);
    bodies_[i].asked.resize(spheres);
    pairs += kMostOfASphere * spheres;
  }
  pairs_.reserve(pairs / 2);
  couples_.reserve(bodies_.size() * bodies_.size() / 2);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      couples_.push_back(
          {.one = &bodies_[i],
           .other = &bodies_[j],
           .most_scale = std::min(models[i]->sizes().most_scale, models[j]->sizes().most_scale),
           .pairs = {},
           .of_one = {},
           .of_other = {},
           .learnt = {}});
  for (Couple& couple : couples_) {
    const ModelSizes one = couple.one->model->sizes(), other = couple.other->model->sizes();
    couple.touches.reserve(std::min(kMostTouches, kMostOfASphere * std::min(one.spheres, other.spheres)));
    if (one.keeps_pushes && other.keeps_pushes)
      couple.pushes.emplace(kMostOfASphere * std::max(one.spheres, other.spheres));
  }
}

bool OrganCollision::run() noexcept {
  if (couples_.empty()) return true;
  gather();
  bool complete = true;
  for (Couple& couple : couples_) complete &= collide(couple);
  for (Couple& couple : couples_) share_out(couple);
  go_on();
  part();
  return complete;
}

void OrganCollision::reset(std::size_t organ) noexcept {
  bodies_[organ].steps = kNever;
  for (Couple& couple : couples_)
    if (couple.one == &bodies_[organ] || couple.other == &bodies_[organ]) {
      couple.learnt = {};
      if (couple.pushes) couple.pushes->forget();
    }
}

void OrganCollision::gather() noexcept {
  pairs_.clear();
  crew_.share(bodies_.size(), [this](std::size_t i) { bodies_[i].spheres = bodies_[i].model->collidable(); });
  for (Body& body : bodies_) {
    body.contacts.clear();
    body.box.setEmpty();
    body.yields = false;
    const std::uint64_t steps = body.model->status().steps;
    body.moved = std::exchange(body.steps, steps) != steps;
    for (const CollisionSphere& sphere : body.spheres) {
      body.box.extend(box_of(sphere));
      body.yields |= std::isfinite(sphere.mass_kg);
    }
    std::ranges::fill(body.asked, 0.0);
  }
}

bool OrganCollision::collide(Couple& couple) noexcept {
  Body &one = *couple.one, &other = *couple.other;
  const std::size_t pairs = pairs_.size(), of_one = one.contacts.size(), of_other = other.contacts.size();
  couple.waits = couple.pushes && !one.moved && !other.moved;
  const bool may_meet = !couple.waits && (one.yields || other.yields) && one.box.intersects(other.box);
  const bool complete = !may_meet || find_pairs(one, other);
  couple.pairs = std::span(pairs_).subspan(pairs);
  couple.of_one = std::span(one.contacts).subspan(of_one);
  couple.of_other = std::span(other.contacts).subspan(of_other);
  couple.answers = !couple.pairs.empty();
  if (couple.pairs.empty() && !couple.waits) couple.learnt = {};
  return complete;
}

bool OrganCollision::find_pairs(Body& one, Body& other) noexcept {
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
      pairs_.push_back({.one = static_cast<std::int32_t>(i),
                        .other = static_cast<std::int32_t>(j),
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
void OrganCollision::share_out(Couple& couple) noexcept {
  const auto asked = [](const Body& body, const OrganContact& contact) {
    return body.asked[static_cast<std::size_t>(contact.sphere)];
  };
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    Pair& pair = couple.pairs[i];
    const double sum = asked(*couple.one, couple.of_one[i]) + asked(*couple.other, couple.of_other[i]);
    pair.share_of_one /= sum;
    pair.share_of_other /= sum;
    pair.weight_kg /= sum;
  }
}

void OrganCollision::go_on() noexcept {
  for (Couple& couple : couples_)
    if (couple.pushes && couple.answers) go_on(couple);
}

// What rests has its weight carried from the first round on.
void OrganCollision::go_on(Couple& couple) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    Pair& pair = couple.pairs[i];
    const Push* const push = couple.pushes->find(pair.one, pair.other);
    if (push == nullptr || !(pair.weight_kg > 0)) continue;
    pair.push_m_s = push->along / pair.weight_kg;
    pair.rub_m_s = geometry::across(push->across, couple.of_one[i].normal) / pair.weight_kg;
    any = true;
  }
  if (any) respond(couple, 1, true);
}

void OrganCollision::remember(Couple& couple) noexcept {
  couple.pushes->forget();
  for (const Pair& pair : couple.pairs) {
    if (!(pair.pushed > 0)) continue;
    const auto [entry, is_new] = couple.pushes->remember(pair.one, pair.other);
    if (is_new) entry->value = {pair.pushed * pair.weight_kg, pair.rubbed * pair.weight_kg};
  }
}

// What rubs brings sliding to rest, as far as the push allows (Coulomb).
void OrganCollision::rub(Couple& couple, std::size_t i) noexcept {
  Pair& pair = couple.pairs[i];
  const OrganContact& of_one = couple.of_one[i];
  const Vec3 sliding = geometry::across(
      couple.one->velocity(of_one.sphere) - couple.other->velocity(couple.of_other[i].sphere), of_one.normal);
  const Vec3 wish = pair.rubbed - couple.learnt.scale * sliding;
  const double length = wish.norm(), most = kFriction * pair.pushed;
  const Vec3 rubbed = length > most ? Vec3(most / length * wish) : wish;
  pair.rub_m_s = (rubbed - pair.rubbed) / couple.learnt.scale;
}

// Two organs after two, as Gauss and Seidel do: an organ between others moves by one push at a time, so that
// what a push did is nobody else's.
void OrganCollision::part() noexcept {
  bool goes_on = true;
  for (int round = 0; goes_on && round < kRounds; ++round) {
    goes_on = false;
    for (Couple& couple : couples_)
      if (couple.answers) goes_on |= part(couple, round == 0);
  }
  for (Couple& couple : couples_)
    if (couple.pushes && !couple.waits) remember(couple);
}

// False where too little is lacking. Tissue pushes, never pulls.
bool OrganCollision::part(Couple& couple, bool in_any_case) noexcept {
  double before = 0, weight_kg = 0;
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    Pair& pair = couple.pairs[i];
    pair.push_m_s = std::max(lacking(couple, i), -pair.pushed / couple.learnt.scale);
    before += pair.weight_kg * pair.push_m_s * pair.push_m_s;
    weight_kg += pair.weight_kg;
  }
  // once in any case: who is met looks ahead in the next round
  if (!in_any_case && before <= weight_kg * kUnnoticed_m_s * kUnnoticed_m_s) return false;
  respond(couple, couple.learnt.scale, false);
  couple.answers = before == 0 || answered(couple);
  learn(couple, before);
  return true;
}

// Its contacts say how fast both spheres are by now, and what is left to do.
void OrganCollision::respond(Couple& couple, double scale, bool goes_on) noexcept {
  Body &one = *couple.one, &other = *couple.other;
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    OrganContact &of_one = couple.of_one[i], &of_other = couple.of_other[i];
    Pair& pair = couple.pairs[i];
    pair.pushed += scale * pair.push_m_s;
    of_one.velocity = other.velocity(of_other.sphere);
    of_other.velocity = one.velocity(of_one.sphere);
    of_one.push_m_s = of_other.push_m_s = pair.push_m_s;
    if (couple.pushes) {
      if (!goes_on) rub(couple, i);
      pair.rubbed += scale * pair.rub_m_s;
      of_one.rubs_on = of_other.rubs_on = true;
      of_one.rub_m_s = pair.rub_m_s;
      of_other.rub_m_s = -pair.rub_m_s;
    }
    of_one.share = scale * pair.share_of_one;
    of_other.share = scale * pair.share_of_other;
    of_one.goes_on = of_other.goes_on = goes_on;
  }
  const std::array sides{std::pair(&one, couple.of_one), std::pair(&other, couple.of_other)};
  crew_.share(2, [&](std::size_t side) {
    const auto& [body, contacts] = sides[side];
    body->model->respond(contacts);
    body->spheres = body->model->collidable();
  });
}

// Some sphere is no longer as fast as its contact says.
bool OrganCollision::answered(const Couple& couple) noexcept {
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    const OrganContact &of_one = couple.of_one[i], &of_other = couple.of_other[i];
    if (couple.one->velocity(of_one.sphere) != of_other.velocity) return true;
    if (couple.other->velocity(of_other.sphere) != of_one.velocity) return true;
  }
  return false;
}

// Steepest descent with a step that was right for the round before (Barzilai and Borwein, 1988, IMA J. Numer.
// Anal. 8), but no longer than was right for the stiffest push since these two met: the rounds may end at
// any, and with a step that grows again what rests would shake each time that it is too long.
void OrganCollision::learn(Couple& couple, double before) noexcept {
  Learnt& learnt = couple.learnt;
  learnt.scale = std::min(learnt.scale, kCaution * couple.most_scale);
  // until then they did not look ahead: what changed is not the push's doing alone
  if (std::exchange(learnt.is_first, false) || !(before > 0)) return;
  double after = 0;
  for (std::size_t i = 0; i < couple.pairs.size(); ++i)
    after += couple.pairs[i].weight_kg * couple.pairs[i].push_m_s * lacking(couple, i);
  const double done = 1 - after / before;
  if (!(done > 0)) return;
  const double most = couple.most_scale;
  learnt.steepest = std::clamp(learnt.scale / done, 1 / most, std::min(most, learnt.steepest));
  learnt.scale = kCaution * learnt.steepest;
}

double OrganCollision::lacking(const Couple& couple, std::size_t pair) noexcept {
  OrganContact of_one = couple.of_one[pair];
  of_one.velocity = couple.other->velocity(couple.of_other[pair].sphere);
  return lacking_speed(of_one, couple.one->velocity(of_one.sphere));
}

}  // namespace omentum::deform
