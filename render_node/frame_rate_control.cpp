#include "render_node/frame_rate_control.h"

#include <algorithm>

namespace omentum::render {
namespace {

constexpr double kSmoothing = 0.2;  // weight of the newest cost
constexpr int kFramesToJudge = 8;   // the first frames of a quality make its buffers and are slower
// Neighbouring qualities differ by about 2.5 in cost; a frame this far below the budget still fits it one
// step finer.
constexpr double kRoomToBeFiner = 5;

Quality coarser(Quality q) {
  return q == Quality::kFine ? Quality::kPlain : Quality::kCoarse;
}
Quality finer(Quality q) {
  return q == Quality::kCoarse ? Quality::kPlain : Quality::kFine;
}

}  // namespace

void FrameRateControl::record(double begin_s, double cost_s) {
  cost_s_ = frames_ == 0 ? cost_s : (1 - kSmoothing) * cost_s_ + kSmoothing * cost_s;
  ++frames_;
  next_s_ = begin_s + std::max(period_s_, cost_s_ / duty_);
  if (frames_ < kFramesToJudge) return;
  const double budget_s = duty_ * period_s_;
  const Quality wanted = cost_s_ > budget_s                    ? coarser(quality_)
                         : kRoomToBeFiner * cost_s_ < budget_s ? finer(quality_)
                                                               : quality_;
  if (wanted == quality_) return;
  quality_ = wanted;
  frames_ = 0;
}

}  // namespace omentum::render
