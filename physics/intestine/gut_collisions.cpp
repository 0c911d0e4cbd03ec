#include "physics/intestine/gut_collisions.h"

#include "physics/intestine/active_pairs.h"
#include "physics/intestine/complete_pairs.h"
#include "physics/intestine/displacement_bound.h"
#include "physics/intestine/gut_chords.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Room for contacts: of pairs and of spheres for each part, with walls for each mass. A gut at rest has one
// for four parts, a box' corner three for each mass in it; what finds no room is told, and held apart by the
// bound where it is no wall.
constexpr std::size_t kContactsPerPart = 16, kSpheresPerPart = 4, kWallsPerMass = 8;

// The least way of a sphere, m, in which it meets all the force that drives it: so far it gives way where it
// would stand.
constexpr double kGiveWay_m = 1e-3;

ContactRoom room_for(const PairFinder& finder, const GutParts& parts) {
  const auto count = static_cast<std::size_t>(parts.count()),
             masses = static_cast<std::size_t>(parts.gut.mass_count());
  return {std::min(finder.most_pairs(), kContactsPerPart * count), kSpheresPerPart * count,
          kWallsPerMass * masses};
}

void require(bool good, const char* expectation) {
  if (!good) throw std::invalid_argument(std::string("collisions of an intestine: ") + expectation);
}

std::unique_ptr<PairFinder> finder_of(const GutParts& parts, const GutCollisionSettings& settings) {
  if (settings.method == GutPairMethod::kStochastic)
    return std::make_unique<ActivePairs>(parts, settings.random_pairs, settings.seed);
  return std::make_unique<CompletePairs>(parts);
}

// Normals turn from step to step: what a push has beside its normal then stays within its friction.
Vec3 within_friction(const Vec3& push, const Vec3& normal, double friction) {
  const double along = std::max(0.0, push.dot(normal)), most = friction * along;
  const Vec3 rubbing = push - push.dot(normal) * normal;
  const double length = rubbing.norm();
  return along * normal + (length > most ? Vec3(rubbing * (most / length)) : rubbing);
}

}  // namespace

GutCollisions::GutCollisions(const geometry::GutShape& shape, std::span<const double> masses_kg,
                             double step_s, const GutCollisionSettings& settings)
    : parts_(shape),
      step_s_(step_s),
      settings_(settings),
      finder_(finder_of(parts_, settings)),
      spheres_(parts_),
      response_(room_for(*finder_, parts_).all(), settings.passes, settings.friction),
      room_(room_for(*finder_, parts_)),
      pushes_(room_.all()),
      carry_(shape.layout.mass_count(),
             masses_kg.size() + static_cast<std::size_t>(std::max(settings.most_spheres, 0)), room_.all(),
             settings.friction) {
  const auto masses = static_cast<std::size_t>(shape.layout.mass_count());
  require(masses_kg.size() == masses, "one mass in kg for each of the grid is expected");
  require(step_s > 0 && std::isfinite(step_s), "a step above 0 s is expected");
  require(settings.passes >= 1, "one pass or more is expected");
  require(settings.friction >= 0 && std::isfinite(settings.friction), "friction of 0 or more is expected");
  require(settings.random_pairs >= 0 && settings.most_spheres >= 0, "numbers of 0 or more are expected");
  const std::size_t all = masses + static_cast<std::size_t>(settings.most_spheres);
  near_.pairs.reserve(finder_->most_pairs());
  near_.gap.resize(masses);
  way_.resize(masses);
  contacts_.reserve(room_.all());
  for (auto* of_all : {&before_, &x_, &v_}) of_all->resize(all);
  gap_.resize(all);
  held_.resize(all);
  keys_.reserve(contacts_.capacity());
  warm_.reserve(contacts_.capacity());
  outcomes_.reserve(static_cast<std::size_t>(settings.most_spheres));
  inverse_mass_.resize(all);
  for (std::size_t m = 0; m < masses; ++m) {
    if (shape.layout.is_held(MassId(m))) continue;
    require(masses_kg[m] > 0 && std::isfinite(masses_kg[m]), "masses above 0 kg are expected");
    inverse_mass_[m] = 1 / masses_kg[m];
  }
}

void GutCollisions::take_in(std::span<const Vec3> before, const GutState& state,
                            std::span<const MovingSphere> spheres) noexcept {
  std::ranges::copy(before, before_.begin());
  std::ranges::copy(state.x, x_.begin());
  std::ranges::copy(state.v, v_.begin());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const std::size_t mass = before.size() + k;
    before_[mass] = spheres[k].before;
    x_[mass] = spheres[k].after;
    v_[mass] = (spheres[k].after - spheres[k].before) / step_s_;
    inverse_mass_[mass] = spheres[k].mass_kg > 0 ? 1 / spheres[k].mass_kg : 0;
  }
}

void GutCollisions::hold_back(std::size_t count, std::span<const Vec3> carried) noexcept {
  bound_displacements(std::span(before_).first(count), carried, std::span(gap_).first(count), step_s_,
                      std::span(x_).first(count), std::span(v_).first(count), held_);
}

// A sphere that is stopped gave up its way in this step: its mass is such that this takes all of its force.
void GutCollisions::limit_forces(std::span<const MovingSphere> spheres) noexcept {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const std::size_t mass = way_.size() + k;
    const double way_m = std::max((x_[mass] - before_[mass]).norm(), kGiveWay_m);
    const double yield_1_kg = way_m / (spheres[k].most_force_n * step_s_ * step_s_);
    inverse_mass_[mass] = std::max(inverse_mass_[mass], yield_1_kg);
  }
}

void GutCollisions::find_pairs(std::span<const Vec3> before) noexcept {
  const double farthest = kShareOfGap * finder_->farthest_gap_m();
  for (std::size_t m = 0; m < before.size(); ++m) {
    const double way = (x_[m] - before[m]).norm();
    way_[m] = way < farthest ? way : farthest;
  }
  finder_->find(before, way_, watched_m(), near_);
  std::ranges::copy(near_.gap, gap_.begin());
  spread_gaps(parts_, std::span(gap_).first(before.size()));
}

double GutCollisions::watched_m() const noexcept {
  return kWatched * parts_.least_reach_m();
}

// A pair that pushed goes on where it is, also when another pair has come to report the same place.
void GutCollisions::gather_pairs(std::span<const Vec3> before) noexcept {
  for (const NearPair& pair : near_.pairs) {
    const Push* const push = pushes_.find(pair.segment, pair.part);
    if (!pair.reports && (push == nullptr || push->impulse.isZero())) continue;
    const GutContact contact = contact_of(parts_, before, pair.segment, pair.part, pair.places);
    const double open = (place_of(contact.one, x_) - place_of(contact.other, x_)).dot(contact.normal);
    if (open >= contact.reach_m + watched_m()) continue;
    if (contacts_.size() == room_.pairs) {
      ++report_.left_out;
      continue;
    }
    contacts_.push_back(contact);
    keys_.push_back({pair.segment, pair.part});
  }
}

void GutCollisions::gather_walls(std::span<const GutObstacle> obstacles) noexcept {
  std::int32_t key = -1 - settings_.most_spheres;
  for (const GutObstacle& obstacle : obstacles) {
    key -= WallFaces::kMostFaces;
    for (MassId m(0); m < parts_.gut.mass_count(); m = MassId(m + 1))
      if (inverse_mass_[m] != 0) gather_faces(obstacle, m, key);
  }
}

void GutCollisions::gather_faces(const GutObstacle& obstacle, MassId m, std::int32_t key) noexcept {
  const double radius = parts_.reach.tube_m / 2;
  const double reach = parts_.gut.row(m) == 0 ? radius : parts_.reach.mesentery_m - radius;
  const WallFaces faces = faces_within(obstacle, x_[m], reach + watched_m());
  for (const WallPlace& wall : faces.near()) {
    if (contacts_.size() == room_.all()) {
      ++report_.left_out;
      continue;
    }
    contacts_.push_back({.one = {{m, MassId(), MassId()}, {1, 0, 0}},
                         .other = {},
                         .place = x_[m] - wall.depth_m * wall.inward,
                         .normal = wall.inward,
                         .reach_m = reach});
    keys_.push_back({key + wall.face, m});
  }
}

void GutCollisions::gather_spheres(std::span<const MovingSphere> spheres) noexcept {
  const auto masses = static_cast<std::size_t>(parts_.gut.mass_count());
  if (spheres.empty()) return;
  const std::span<const Vec3> x = std::span(x_).first(masses);
  spheres_.look_at(x);
  for (std::size_t k = 0; k < spheres.size(); ++k)
    report_.left_out += spheres_.add_contacts(x, x_[masses + k], spheres[k].radius_m, MassId(masses + k),
                                              -1 - static_cast<std::int32_t>(k), watched_m(),
                                              room_.with_spheres(), contacts_, keys_);
}

void GutCollisions::recall_pushes() noexcept {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Push* const push = pushes_.find(keys_[c].one, keys_[c].other);
    if (push != nullptr) warm_[c] = within_friction(push->impulse, contacts_[c].normal, settings_.friction);
  }
}

void GutCollisions::remember_pushes() noexcept {
  is_carried_ = true;
  pushes_.forget();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto [entry, is_new] = pushes_.remember(keys_[c].one, keys_[c].other);
    if (is_new) entry->value.impulse = response_.impulse(c);
  }
}

void GutCollisions::tell_spheres(std::size_t count) noexcept {
  const auto masses = static_cast<std::size_t>(parts_.gut.mass_count());
  for (std::size_t k = 0; k < count; ++k) outcomes_.push_back({.reached = x_[masses + k]});
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const std::int32_t other = contacts_[c].other.mass[0];
    if (other >= static_cast<std::int32_t>(masses))
      outcomes_[static_cast<std::size_t>(other) - masses].impulse -= response_.impulse(c);
  }
}

void GutCollisions::resolve(std::span<const Vec3> before, GutState& state,
                            std::span<const GutObstacle> obstacles, std::span<const MovingSphere> spheres,
                            GutYield* yield, std::span<const Vec3> carried) noexcept {
  const std::size_t known = std::min(spheres.size(), static_cast<std::size_t>(settings_.most_spheres));
  report_.left_out += static_cast<std::int64_t>(spheres.size() - known);
  spheres = spheres.first(known);
  gather(before, state, obstacles, spheres, carried);
  const std::size_t count = before.size() + spheres.size();
  const MovingMasses masses{before_, std::span(x_).first(count), std::span(v_).first(count), inverse_mass_};
  warm_.assign(yield != nullptr ? contacts_.size() : 0, Vec3::Zero());
  if (yield != nullptr) {
    recall_pushes();
    std::ranges::fill(held_, 0);
    std::ranges::copy(state.x, x_.begin());
    std::ranges::copy(state.v, v_.begin());
    carry_.solve(contacts_, *yield, step_s_, masses, warm_);
    hold_back(count, carried);
  }
  response_.solve(contacts_, warm_, step_s_, masses);
  if (yield != nullptr) remember_pushes();
  hold_back(count, carried);
  keep_near_chords(parts_, step_s_, std::span(x_).first(before.size()), std::span(v_).first(before.size()),
                   std::span(held_).first(before.size()));
  tell_spheres(spheres.size());
  std::copy_n(x_.begin(), before.size(), state.x.begin());
  std::copy_n(v_.begin(), before.size(), state.v.begin());
  tell(masses);
}

// Pairs and contacts, where the masses want to be as far as the bound lets them.
void GutCollisions::gather(std::span<const Vec3> before, const GutState& state,
                           std::span<const GutObstacle> obstacles, std::span<const MovingSphere> spheres,
                           std::span<const Vec3> carried) noexcept {
  contacts_.clear();
  keys_.clear();
  outcomes_.clear();
  std::ranges::fill(held_, 0);
  take_in(before, state, spheres);
  find_pairs(before);
  if (!spheres.empty()) {
    spheres_.look_at(before);
    spheres_.lower_gaps(before, spheres, gap_);
  }
  hold_back(before.size() + spheres.size(), carried);
  limit_forces(spheres);
  gather_pairs(before);
  gather_spheres(spheres);
  gather_walls(obstacles);
}

void GutCollisions::tell(const MovingMasses& masses) noexcept {
  report_.contacts = response_.pushing();
  report_.pairs_tracked = static_cast<std::int64_t>(finder_->tracked());
  report_.distance_tests = finder_->distance_tests();
  report_.bound_acted += std::ranges::count(held_, 1);
  report_.deepest_m = response_.deepest_m(masses);
}

void GutCollisions::reset() noexcept {
  finder_->reset();
  pushes_.forget();
  is_carried_ = false;
  near_.pairs.clear();
  contacts_.clear();
  keys_.clear();
  outcomes_.clear();
  report_ = {};
}

void GutCollisions::take_up(const GutCollisions& other) noexcept {
  reset();
  finder_->take_up(*other.finder_);
  const double longer = step_s_ / other.step_s_;
  pushes_.take_over(other.pushes_, [longer](const Push& push) { return Push{longer * push.impulse}; });
}

}  // namespace omentum::physics
