#include "deform_node/gut_model.h"

#include "deform_node/gut_gauge.h"
#include "deform_node/skin_faces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace omentum::deform {

using geometry::GutSkin;

namespace {

// A step is taken when all but this share of it has passed, so that rounding of the clock loses none.
constexpr double kStepRounding = 1e-9;
// A press that is as strong as its hand says, to this share, leaves the step as it is.
constexpr double kAsSaid = 1e-6;
// Looks at where a hold leads, of a tick.
constexpr int kLooks = 2;

std::span<double> components(std::vector<Vec3>& x) {
  return {x.front().data(), 3 * x.size()};
}

std::vector<Vec3> places_of(const GutSkin& skin, std::span<const Vec3> x) {
  std::vector<Vec3> places(skin.node_count());
  skin.place(x, places);
  return places;
}

/// What the gut yields to forces on its masses.
class GutYielding final : public physics::Yielding {
 public:
  explicit GutYielding(const physics::GutSystem& gut) : gut_(gut) {}
  double step_s() const override { return gut_.settings().step_s; }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    const std::size_t masses = forces.size() / 3;
    gut_.yield_to({reinterpret_cast<const Vec3*>(forces.data()), masses},
                  {reinterpret_cast<Vec3*>(yield.data()), masses});
  }

 private:
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const physics::GutSystem& gut_;
};

}  // namespace

GutModel::GutModel(GutPhysics parts)
    : system_(std::move(parts.system)),
      felt_(std::move(parts.felt)),
      ahead_(std::move(parts.ahead)),
      obstacles_(std::move(parts.obstacles)),
      skin_(system_->shape()),
      presses_(skin_, places_of(skin_, system_->shape().positions), parts.wall_m_n),
      imposed_(system_->shape().positions.size(), GutPresses::kMostPatterns),
      wanted_(system_->state()),
      values_(3 * system_->shape().positions.size()),
      look_(std::make_unique<Felt>(skin_, system_->shape().positions.size(), parts.wall_m_n)),
      meeting_(std::make_unique<GutMeeting>(*felt_)) {
  status_.collisions.emplace();
  show();
}

GutModel::Felt::Felt(const GutSkin& skin, std::size_t all, double wall_m_n)
    : places(skin.node_count()),
      dented(skin.node_count()),
      next(skin.node_count()),
      ahead(all),
      wanted(all),
      forces(all),
      choice(skin.node_count(), skin.triangles().size(), kPatchNodes),
      compliance(skin, wall_m_n, kPatchNodes) {}

ModelSizes GutModel::sizes() const {
  return {.values = values_.size(),
          .removed_bytes = 0,
          .local_nodes = kPatchNodes,
          .spheres = meeting_->most_spheres(),
          // a step of the springs foresees less of a longer push than comes: a loop that rests would tremble
          .most_scale = 1,
          .costs = true,
          .keeps_pushes = true};
}

void GutModel::step(const TickLoads& loads, double dt_s) noexcept {
  const double step_s = system_->settings().step_s;
  status_.fault = {};
  ahead_s_ += dt_s;
  const auto steps = static_cast<int>(ahead_s_ / step_s + kStepRounding);
  ahead_s_ -= steps * step_s;
  if (steps == 0) return;
  look();
  presses_.press(loads.presses, look_->places, system_->state().x);
  until_felt_s_ = 0;
  last_ticks_s_ = {steps * step_s, last_ticks_s_[0]};
  meeting_->act(last_ticks_s_[0]);
  for (int i = 0; i < steps && !status_.diverged; ++i) advance();
  meeting_->put_down();
  show();
}

void GutModel::advance() noexcept {
  const double step_s = system_->settings().step_s;
  const physics::GutCollisionReport before = system_->report().collisions;
  if (ahead_) press_ahead();
  system_->step(loads());
  if (!ahead_) impose();
  ++status_.steps;
  status_.simulated_s += step_s;
  status_.diverged = system_->report().diverged;
  note_collisions(before);
}

void GutModel::note_collisions(const physics::GutCollisionReport& before) noexcept {
  const physics::GutCollisionReport& now = system_->report().collisions;
  CollisionAccount& account = *status_.collisions;
  account.contacts += static_cast<std::uint64_t>(now.contacts);
  // a step that starts a report anew counts from nothing
  const auto grown = [](std::int64_t then, std::int64_t by_now) {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(by_now - then, 0));
  };
  account.held_back += grown(before.bound_acted, now.bound_acted);
  const std::uint64_t left_out = grown(before.left_out, now.left_out);
  account.left_out += left_out;
  if (left_out > 0) status_.fault = "more contacts than there is room for: some are left out";
  account.deepest_m = std::max(account.deepest_m, now.deepest_m);
}

physics::GutLoads GutModel::loads() const noexcept {
  return {.forces_n = forces(), .obstacles = obstacles_};
}

std::span<const Vec3> GutModel::forces() const noexcept {
  const std::span<const Vec3> of_organs = meeting_->forces();
  if (of_organs.empty()) return presses_.forces();
  std::ranges::transform(presses_.forces(), of_organs, look_->forces.begin(), std::plus{});
  return look_->forces;
}

// Of a gut that was stepped under the hands' own forces: how strong they would have to be.
std::span<const double> GutModel::strengths_on(const physics::GutSystem& gut) noexcept {
  std::ranges::copy(gut.state().x, wanted_.x.begin());
  std::ranges::copy(gut.state().v, wanted_.v.begin());
  GutYielding yielding(*felt_);
  return imposed_.impose(yielding, presses_.presses(), components(wanted_.x), components(wanted_.v));
}

void GutModel::impose() noexcept {
  if (presses_.presses().empty()) return;
  const std::span<const double> strengths = strengths_on(*system_);
  presses_.act(strengths);
  if (presses_.are_as_said(kAsSaid)) return;
  system_->move_to(wanted_, loads());
}

// Steps are short: hands are told, and answered, only now and then, and between hold their strengths.
void GutModel::press_ahead() noexcept {
  until_felt_s_ -= system_->settings().step_s;
  if (until_felt_s_ > kStepRounding || presses_.presses().empty()) return;
  until_felt_s_ = felt_->settings().step_s;
  if (presses_.any_grasps()) return hold(std::min(until_felt_s_, last_ticks_s_[0]));
  presses_.act(1);
  felt_->take_up(*system_);
  felt_->step(loads());
  presses_.act(strengths_on(*felt_));
}

// Jaws hold in all directions, most of them softer than the constant matrix says: their forces are found from
// where the tick's own steps would take the gut; of a late tick, which lives through several periods, one
// period after the other, or what it lacks at first would be made up for with a force that goes far beyond.
void GutModel::hold(double tick_s) noexcept {
  presses_.act(1);
  for (int round = 0; round < kLooks; ++round) {
    run_ahead(tick_s);
    if (!presses_.approach(strengths_on(*ahead_), round == 0)) break;
  }
}

// Returns what that took of the gut's time, s.
double GutModel::run_ahead(double seconds) const noexcept {
  physics::GutSystem& gut = ahead_ ? *ahead_ : *felt_;
  const double step_s = gut.settings().step_s;
  const int steps = std::max(1, static_cast<int>(std::lround(seconds / step_s)));
  gut.take_up(*system_);
  for (int i = 0; i < steps; ++i) gut.step(loads());
  return steps * step_s;
}

void GutModel::reset() noexcept {
  system_->reset();
  felt_->reset();
  presses_.forget();
  meeting_->reset();
  ahead_s_ = until_felt_s_ = 0;
  status_.diverged = false;
  show();
}

void GutModel::show() noexcept {
  look_->is_seen = look_->is_foreseen = look_->is_next_seen = false;
  float* value = values_.data();
  for (const Vec3& x : system_->state().x)
    for (int axis = 0; axis < 3; ++axis) *value++ = static_cast<float>(x[axis]);
}

OrganView GutModel::view() const noexcept {
  return {.kind = StateKind::kTube, .topology_version = 0, .values = values_};
}

std::unique_ptr<StrainGauge> GutModel::strain_gauge() const {
  return std::make_unique<GutGauge>(system_->shape());
}

void GutModel::look() const noexcept {
  if (std::exchange(look_->is_seen, true)) return;
  skin_.place(system_->state().x, look_->places);
  std::ranges::copy(look_->places, look_->dented.begin());
  presses_.dent(look_->dented);
}

// A single late tick does not say when the next one comes.
double GutModel::coming_tick_s() const noexcept {
  const double tick_s = std::min(last_ticks_s_[0], last_ticks_s_[1]);
  return tick_s > 0 ? tick_s : system_->settings().step_s;
}

void GutModel::foresee() const noexcept {
  if (std::exchange(look_->is_foreseen, true)) return;
  const double way_s = run_ahead(std::max(coming_tick_s(), felt_->settings().step_s));
  const physics::GutSystem& gut = ahead_ ? *ahead_ : *felt_;
  for (std::size_t m = 0; m < look_->ahead.size(); ++m)
    look_->ahead[m] = (gut.state().x[m] - system_->state().x[m]) / way_s;
}

// A hand adds what it presses more than now to what is told of now: so that has to be where the gut goes
// under the same press, not how fast it is.
void GutModel::look_ahead() const noexcept {
  if (std::exchange(look_->is_next_seen, true)) return;
  // what guts alone push is not in what was foreseen
  if (!meeting_->foresees()) meeting_->lend(coming_tick_s());
  foresee();
  meeting_->put_down();
  const double step_s = felt_->settings().step_s;
  std::ranges::transform(system_->state().x, look_->ahead, look_->wanted.begin(),
                         [step_s](const Vec3& x, const Vec3& v) -> Vec3 { return x + step_s * v; });
  skin_.place(look_->wanted, look_->next);
}

std::span<const CollisionSphere> GutModel::collidable() const noexcept {
  if (meeting_->foresees()) foresee();
  return meeting_->collidable(system_->state(), look_->ahead);
}

void GutModel::respond(std::span<const OrganContact> contacts) noexcept {
  if (meeting_->foresees() || GutMeeting::is_with_body(contacts)) foresee();
  meeting_->respond(contacts, system_->state(), presses_.forces(), look_->ahead);
  look_->is_next_seen = false;
  if (!meeting_->foresees()) look_->is_foreseen = false;
}

bool GutModel::local_model(const PatchPlace& place, LocalPatch& patch) const noexcept {
  look();
  const SkinFaces faces{skin_, look_->dented, system_->state().x, presses_, place.tool};
  PatchPlace around = place;
  // what is held must not leave the patch where a hand is ahead of a gut that falls behind the clock
  around.centre = presses_.middle(place.tool, look_->dented).value_or(place.centre);
  if (!look_->choice.choose(around, faces, patch)) return false;
  look_ahead();
  patch.topology_version = 0;
  const std::span<const NodeId> nodes = look_->choice.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto n = static_cast<std::size_t>(nodes[i]);
    patch.nodes[i] = static_cast<std::uint32_t>(n);
    patch.velocities[i] = (look_->next[n] - look_->places[n]) / felt_->settings().step_s;
    patch.positions[i] = look_->dented[n] + ahead_s_ * patch.velocities[i];
    patch.forces[i] = presses_.of_tool(place.tool, nodes[i]);
  }
  look_->compliance.find(*felt_, nodes, patch.compliance);
  return true;
}

}  // namespace omentum::deform
