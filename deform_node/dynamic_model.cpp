#include "deform_node/dynamic_model.h"

#include "deform_node/patch_compliance.h"
#include "deform_node/strain_gauges.h"
#include "node_common/organ_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::deform {

using geometry::TetId;

namespace {

constexpr std::size_t kPatchNodes = BodyStepper::kPatchNodes;
// Below this no eye and no hand finds a motion, J: a gram at 1 mm/s.
constexpr double kUnnoticed_j = 5e-10;
// What a step that is exact may seem to gain, by what its equation may lack.
constexpr double kGained = 1e-2;
// A step is taken when all but this share of it has passed, so that rounding of the clock loses none.
constexpr double kRounding = 1e-9;

Vec3 at(const std::vector<double>& components, NodeId n) {
  return Eigen::Map<const Vec3>(components.data() + 3 * n);
}

}  // namespace

DynamicModel::DynamicModel(DynamicParts parts)
    : mesh_(parts.body.mesh),
      material_(parts.body.material),
      stress_(parts.stress),
      gauge_(std::move(parts.gauge)),
      editor_(mesh_, {.smallest_piece_m3 = parts.smallest_piece_m3,
                      .uncut_surface = parts.uncut_surface,
                      .kept = parts.precomputed,
                      .covered = parts.covered}),
      loads_(mesh_, parts.body.material, parts.gravity_m_s2),
      state_(physics::state_at_rest(mesh_.positions.size())),
      before_(state_),
      stepper_(std::move(parts.stepper)),
      watch_(parts.energy_margin, kUnnoticed_j),
      swept_(mesh_),
      precomputed_(std::move(parts.precomputed)),
      burning_(mesh_.tetrahedra.size(), parts.cut_delay_s, parts.cut_rate_per_s),
      tearing_(mesh_, parts.body.material, parts.tears),
      is_static_(parts.is_static),
      parted_(parts.is_static || !parts.massless.empty()
                  ? std::make_unique<PartedTissue>(mesh_, parts.body.inertia.fixed, std::move(parts.massless))
                  : nullptr),
      piece_gravity_(parts.piece_gravity_m_s2),
      reach_m_(node::reach_m(mesh_.positions)),
      burnt_((mesh_.tetrahedra.size() + 7) / 8),
      values_(state_.u.size()),
      gatherer_(std::make_unique<PatchGatherer>(mesh_, kPatchNodes)),
      felt_(std::make_unique<Felt>()),
      meeting_(std::make_unique<BodyMeeting>(
          mesh_, parts.is_static ? PartedTissue::met(parts.body.inertia, piece_gravity_.has_value())
                                 : parts.body.inertia)) {
  felt_->compliance.resize(9 * kPatchNodes * kPatchNodes);
  felt_->ahead.resize(state_.u.size());
  gone_.reserve(mesh_.tetrahedra.size());
  fallen_.reserve(mesh_.tetrahedra.size());
  met_.reserve(mesh_.tetrahedra.size());
}

ModelSizes DynamicModel::sizes() const {
  return {.values = values_.size(),
          .removed_bytes = burnt_.size(),
          .local_nodes = stepper_->is_felt() ? kPatchNodes : 0,
          .spheres = meeting_->most_spheres(),
          .body = values_.size(),
          .costs = true};
}

void DynamicModel::step(const TickLoads& loads, double dt_s) noexcept {
  status_.fault = {};
  const double step_s = stepper_->step_s();
  ahead_s_ += dt_s;
  const auto steps = static_cast<int>(ahead_s_ / step_s + kRounding);
  ahead_s_ -= steps * step_s;
  // not in a tick without a step: a local model says the forces that brought the surface where it is
  if (steps > 0) loads_.press(loads.presses, editor_);
  cut(loads.cuts, dt_s);
  check(dt_s);
  if (steps > 0 && !status_.diverged) advance(steps);
  show();
}

void DynamicModel::advance(int steps) noexcept {
  meeting_->act(steps * stepper_->step_s(), editor_, loads_);
  std::ranges::copy(state_.u, before_.u.begin());
  std::ranges::copy(state_.v, before_.v.begin());
  const physics::EnergyWatch watch = watch_;
  stepper_->prepare();
  status_.diverged = !run(steps, &BodyStepper::step);
  if (status_.diverged) {
    std::swap(state_, before_);
    watch_ = watch;
    status_.diverged = !run_again(steps);
  }
  loads_.put_down();
  status_.simulated_s += steps * stepper_->step_s();
  status_.steps += static_cast<std::uint64_t>(steps);
}

bool DynamicModel::run(int steps, Step step) noexcept {
  for (int i = 0; i < steps; ++i) {
    const auto work_j = (stepper_.get()->*step)(state_, loads_);
    if (!work_j) return false;
    watch_.add_work(*work_j);
  }
  return watch_.accepts(energy_j(), steps * stepper_->step_s());
}

double DynamicModel::energy_j() noexcept {
  return stepper_->elastic_energy(state_.u) + physics::kinetic_energy(stepper_->mass(), state_.v);
}

// Steps that gain nothing are no divergence, also where those before them gained what the account does not
// know.
bool DynamicModel::run_again(int steps) noexcept {
  if (stepper_->shortens()) {
    const bool sound = run(steps, &BodyStepper::step_shorter);
    if (sound) status_.fault = "would diverge, goes on in shorter steps";
    return sound;
  }
  double most_j = energy_j();
  for (int i = 0; i < steps; ++i) {
    const auto work_j = stepper_->step_shorter(state_, loads_);
    if (!work_j) return false;
    watch_.add_work(*work_j);
    most_j += *work_j;
  }
  const double now_j = energy_j();
  return watch_.accepts(now_j, steps * stepper_->step_s()) || now_j <= (1 + kGained) * most_j;
}

void DynamicModel::reset() noexcept {
  list_removed();
  if (!gone_.empty()) ++version_;
  stepper_->restore(gone_);
  editor_.restore();
  loads_.restore();
  burning_.clear();
  std::ranges::fill(burnt_, std::uint8_t{0});
  watch_.restart(0);
  meeting_->reset();
  if (parted_) parted_->restore();
  std::ranges::fill(state_.u, 0.0);
  std::ranges::fill(state_.v, 0.0);
  ahead_s_ = until_check_s_ = 0;
  status_.removed_tetrahedra = 0;
  status_.diverged = false;
  show();
}

void DynamicModel::take_up(std::span<const std::uint8_t> removed_bits,
                           std::span<const std::uint8_t> burnt_bits, std::uint64_t version) noexcept {
  reset();
  editor_.set_removed(removed_bits);
  list_removed();
  put_back_precomputed();
  if (!gone_.empty()) part_unheld();
  const std::span<const std::uint8_t> removed = editor_.removed_bits();
  for (std::size_t i = 0; i < std::min(burnt_bits.size(), burnt_.size()); ++i)
    burnt_[i] = burnt_bits[i] & removed[i];
  version_ = version;
  show();
}

void DynamicModel::show() noexcept {
  felt_->is_foreseen = false;
  float* value = values_.data();
  for (const NodeId n : editor_.surface_nodes())
    for (int axis = 0; axis < 3; ++axis) *value++ = static_cast<float>(state_.u[3 * n + axis]);
}

std::span<const CollisionSphere> DynamicModel::collidable() const noexcept {
  return meeting_->collidable({editor_, version_}, state_, *stepper_, loads_.external());
}

void DynamicModel::respond(std::span<const OrganContact> contacts) noexcept {
  if (!is_static_ || parted_->any()) meeting_->respond(contacts, state_, *stepper_, loads_.external());
  felt_->is_foreseen = false;
}

OrganView DynamicModel::view() const noexcept {
  return {.kind = StateKind::kSurface,
          .topology_version = version_,
          .values = std::span(values_).first(3 * editor_.surface_nodes().size()),
          .removed_bits = editor_.removed_bits(),
          .burnt_bits = burnt_,
          .body_u = state_.u,
          .surface = editor_.surface_nodes()};
}

std::unique_ptr<StrainGauge> DynamicModel::strain_gauge() const {
  return gauge_ ? gauge_() : std::make_unique<BodyGauge>(mesh_, material_, stress_);
}

// What others push is not among the forces before the next step.
void DynamicModel::look_ahead() const noexcept {
  if (std::exchange(felt_->is_foreseen, true)) return;
  const std::span<const double> pushed = meeting_->ahead();
  if (!pushed.empty()) {
    std::ranges::copy(pushed, felt_->ahead.begin());
    return;
  }
  stepper_->foresee(state_, loads_.external(), felt_->ahead);
  for (std::size_t c = 0; c < state_.u.size(); ++c)
    felt_->ahead[c] = (felt_->ahead[c] - state_.u[c]) / stepper_->felt_s();
}

bool DynamicModel::local_model(const PatchPlace& place, LocalPatch& patch) const noexcept {
  if (!stepper_->is_felt()) return false;
  PatchPlace around = place;
  around.held = loads_.held_by(place.tool);
  if (!gatherer_->gather(around, editor_, state_.u, patch)) return false;
  const std::span<const NodeId> nodes = gatherer_->nodes();
  look_ahead();
  patch.topology_version = version_;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    patch.velocities[i] = at(felt_->ahead, nodes[i]);
    patch.positions[i] = mesh_.positions[nodes[i]] + at(state_.u, nodes[i]) + ahead_s_ * patch.velocities[i];
    patch.forces[i] = loads_.of_tool(place.tool, nodes[i]);
  }
  const std::span<float> block = std::span(felt_->compliance).first(9 * nodes.size() * nodes.size());
  stepper_->compliance(nodes, block);
  return tell_compliance(block, patch);
}

}  // namespace omentum::deform
