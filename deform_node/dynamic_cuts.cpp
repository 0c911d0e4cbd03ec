// What goes of an organ that moves by itself: strokes, cracks, and pieces that nothing holds any more.
#include "deform_node/dynamic_model.h"

#include <algorithm>

namespace omentum::deform {

using geometry::TetId;

namespace {

// As often as a screen shows it.
constexpr double kTearCheck_s = 1.0 / 60;
// Of one check: a crack runs by hundreds of tetrahedra a second, and each check leaves time for a step.
constexpr std::size_t kMostTorn = 4;

double volume_of(const geometry::TetraMesh& mesh, TetId t) {
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  const auto& x = mesh.positions;
  return geometry::signed_volume(x[a], x[b], x[c], x[d]);
}

}  // namespace

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
  const auto is_gone = [&](NodeId n) {
    return !(Vec3::Map(&state_.u[3 * static_cast<std::size_t>(n)]).squaredNorm() < reach_m_ * reach_m_);
  };
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
  std::span<const TetId> pieces = parted_ ? parted_->find(editor_) : std::span<const TetId>();
  if (piece_gravity_ && !is_static_ && !pieces.empty()) pieces = off_supports(pieces);
  const bool fall = piece_gravity_ && !pieces.empty();
  const double held_j = fall ? stepper_->elastic_energy(state_.u) : 0;
  if (fall) let_go(pieces);
  if (!fall && !pieces.empty()) add_gone(editor_.remove(pieces));
  forgo_gone();
  // the law by which they go on may say more of the same shape: that is no divergence
  if (fall) watch_.add_work(std::max(0.0, stepper_->elastic_energy(state_.u) - held_j));
}

// In a factor of its own a piece has no supports. In that of the whole it would swing from a node or an edge
// that one holds: what is tied there goes.
std::span<const TetId> DynamicModel::off_supports(std::span<const TetId> pieces) noexcept {
  const std::span<const TetId> tied = parted_->on_supports(pieces);
  if (tied.empty()) return pieces;
  const geometry::Removal removal = editor_.remove(tied);
  status_.repaired_tetrahedra += static_cast<std::uint32_t>(removal.asked.size());
  add_gone(removal);
  return parted_->find(editor_);
}

void DynamicModel::let_go(std::span<const TetId> pieces) noexcept {
  parted_->let_go(pieces, stepper_->mass(), state_.v);
  stepper_->let_go(pieces);
  loads_.let_go(pieces, *piece_gravity_);
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

}  // namespace omentum::deform
