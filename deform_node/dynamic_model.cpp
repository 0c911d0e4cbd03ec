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
// As often as a screen shows it.
constexpr double kTearCheck_s = 1.0 / 60;
// Of one check: a crack runs by hundreds of tetrahedra a second, and each check leaves time for a step.
constexpr std::size_t kMostTorn = 4;
// Below this no eye and no hand finds a motion, J: a gram at 1 mm/s.
constexpr double kUnnoticed_j = 5e-10;
// A step is taken when all but this share of it has passed, so that rounding of the clock loses none.
constexpr double kRounding = 1e-9;

double volume_of(const geometry::TetraMesh& mesh, TetId t) {
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  const auto& x = mesh.positions;
  return geometry::signed_volume(x[a], x[b], x[c], x[d]);
}

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
      parted_(parts.is_static ? std::make_unique<PartedTissue>(mesh_, parts.body.inertia.fixed) : nullptr),
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

void DynamicModel::cut(std::span<const CutStroke> strokes, double dt_s) noexcept {
  status_.cuts.tools = 0;
  if (!strokes.empty()) swept_.follow(state_.u);
  for (const CutStroke& stroke : strokes) {
    const std::span<const TetId> met = those_that_can_go(swept_.find({stroke.from, stroke.to}));
    burning_.meet(met, editor_);
    if (met.empty()) continue;
    status_.cuts.way_m += (stroke.to[0] + stroke.to[1] - stroke.from[0] - stroke.from[1]).norm() / 2;
    status_.cuts.tools |= 1U << stroke.tool % 32;
  }
  const std::span<const TetId> burnt = burning_.burn(dt_s, editor_);
  for (const TetId t : burnt) burnt_[t / 8] = static_cast<std::uint8_t>(burnt_[t / 8] | 1 << t % 8);
  for (const TetId t : remove(burnt)) status_.cuts.lost_m3 += volume_of(mesh_, t);
}

std::span<const TetId> DynamicModel::those_that_can_go(std::span<const TetId> met) noexcept {
  if (precomputed_.empty()) return met;
  met_.clear();
  std::ranges::copy_if(met, std::back_inserter(met_), [&](TetId t) { return can_go(t); });
  return met_;
}

void DynamicModel::check(double dt_s) noexcept {
  until_check_s_ -= dt_s;
  if (until_check_s_ > 0) return;
  until_check_s_ = std::max(until_check_s_ + kTearCheck_s, 0.0);
  remove(tearing_.check(state_.u, editor_.removed_bits(), kMostTorn));
  drop_what_fell();
}

void DynamicModel::drop_what_fell() noexcept {
  const auto is_gone = [&](NodeId n) { return !(at(state_.u, n).squaredNorm() < reach_m_ * reach_m_); };
  fallen_.clear();
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    if (can_go(TetId(t)) && !editor_.is_removed(TetId(t)) &&
        std::ranges::any_of(mesh_.tetrahedra[t], is_gone))
      fallen_.push_back(TetId(t));
  remove(fallen_);
}

std::span<const TetId> DynamicModel::remove(std::span<const TetId> tetrahedra) noexcept {
  if (tetrahedra.empty()) return {};
  gone_.clear();
  add_gone(editor_.remove(tetrahedra));
  if (gone_.empty()) return {};
  ++version_;
  part_unheld();
  return gone_;
}

// By topology, before anything is solved of what is left.
void DynamicModel::part_unheld() noexcept {
  const std::span<const TetId> pieces = parted_ ? parted_->find(editor_) : std::span<const TetId>();
  const bool fall = piece_gravity_ && !pieces.empty();
  const double held_j = fall ? stepper_->elastic_energy(state_.u) : 0;
  if (fall) let_go(pieces);
  if (!fall && !pieces.empty()) add_gone(editor_.remove(pieces));
  forgo_gone();
  // the law by which they go on may say more of the same shape: that is no divergence
  if (fall) watch_.add_work(std::max(0.0, stepper_->elastic_energy(state_.u) - held_j));
}

void DynamicModel::let_go(std::span<const TetId> pieces) noexcept {
  stepper_->let_go(pieces);
  loads_.let_go(pieces, *piece_gravity_);
  parted_->let_go(pieces, state_.v);
}

void DynamicModel::add_gone(const geometry::Removal& removal) noexcept {
  gone_.insert(gone_.end(), removal.asked.begin(), removal.asked.end());
  gone_.insert(gone_.end(), removal.repaired.begin(), removal.repaired.end());
  gone_.insert(gone_.end(), removal.dropped.begin(), removal.dropped.end());
  status_.repaired_tetrahedra += static_cast<std::uint32_t>(removal.repaired.size());
}

void DynamicModel::forgo_gone() noexcept {
  status_.removed_tetrahedra = static_cast<std::uint32_t>(editor_.removed_count());
  if (!stepper_->remove(gone_)) status_.diverged = true;
  loads_.lighten(gone_, editor_);
  for (const TetId t : gone_)
    for (const NodeId n : mesh_.tetrahedra[t])
      if (editor_.uses(n) == 0) Eigen::Map<Vec3>(state_.v.data() + 3 * n).setZero();
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
    status_.diverged = !run(steps, &BodyStepper::step_shorter);
    if (!status_.diverged) status_.fault = "would diverge, goes on in shorter steps";
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
  const double energy_j =
      stepper_->elastic_energy(state_.u) + physics::kinetic_energy(stepper_->mass(), state_.v);
  return watch_.accepts(energy_j, steps * stepper_->step_s());
}

void DynamicModel::list_removed() noexcept {
  gone_.clear();
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    if (editor_.is_removed(TetId(t))) gone_.push_back(TetId(t));
}

// Whatever somebody says is gone. Rare: at worst O(T) for each.
void DynamicModel::put_back_precomputed() noexcept {
  if (std::ranges::all_of(gone_, [&](TetId t) { return can_go(t); })) return;
  std::erase_if(gone_, [&](TetId t) { return !can_go(t); });
  editor_.restore();
  editor_.remove(gone_);
  list_removed();
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
  if (!gone_.empty() && piece_gravity_) let_go(parted_->find(editor_));
  if (!gone_.empty()) forgo_gone();
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
  if (!parted_ || parted_->any()) meeting_->respond(contacts, state_, *stepper_, loads_.external());
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
