#include "deform_node/cut_queue.h"

#include <algorithm>

namespace omentum::deform {

using geometry::MeshEditor;
using geometry::TetId;

CutQueue::CutQueue(std::size_t tetrahedra, double delay_s, double rate_per_s)
    : delay_s_(delay_s), rate_per_s_(rate_per_s), ring_(tetrahedra), waits_(tetrahedra) {
  burnt_.reserve(tetrahedra);
}

void CutQueue::meet(std::span<const TetId> met, const MeshEditor& editor) noexcept {
  for (const TetId t : met) {
    if (waits_[t] || editor.is_removed(t)) continue;
    waits_[t] = true;
    ring_[(first_ + count_++) % ring_.size()] = {t, now_s_ + delay_s_};
  }
}

std::span<const TetId> CutQueue::burn(double dt_s, const MeshEditor& editor) noexcept {
  burnt_.clear();
  now_s_ += dt_s;
  // what was not used up while nothing waited is no reason for many to go at once
  allowance_ = count_ == 0 ? 0 : allowance_ + rate_per_s_ * dt_s;
  while (count_ > 0 && ring_[first_].until_s <= now_s_) {
    const TetId t = ring_[first_].t;
    const bool is_there = !editor.is_removed(t);
    if (is_there && allowance_ < 1) return burnt_;
    first_ = (first_ + 1) % ring_.size();
    --count_;
    waits_[t] = false;
    if (!is_there) continue;
    allowance_ -= 1;
    burnt_.push_back(t);
  }
  allowance_ = std::min(allowance_, 1.0);
  return burnt_;
}

void CutQueue::clear() noexcept {
  first_ = count_ = 0;
  allowance_ = now_s_ = 0;
  waits_.assign(waits_.size(), false);
}

}  // namespace omentum::deform
