#include "render_node/frame_rate_control.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr double kAlpha = 4;  // over f0^2: settles in a third of a second at any rate (eq. 15 has it for one)
// The asked rate holds up to this much over what a new level may cost: without the band, a level whose cost
// is the budget would come and go with every noise.
constexpr double kBand = 1.15;
// Too dear, by how many frames it takes to say so: two, a trial's, and all that are kept.
constexpr double kFar = 1.7, kNear = 1.2, kBarely = kBand;
constexpr double kLongFrame_s = 0.25;  // or one that took so long
constexpr double kRoom = 1.35;         // a frame so far below the budget: all means become finer together
constexpr double kSure = 0.85;         // of the budget: a trial that costs less needs no more frames
constexpr std::size_t kFew = 3;        // than these
constexpr double kClearly = 0.93;      // of the budget: what a refused step must be foretold to cost
constexpr double kRefused_s = 60;      // a scene may have changed what a step costs

}  // namespace

FrameRateControl::FrameRateControl(double most_fps, double duty)
    : period_s_(1 / most_fps), most_s_(duty * period_s_), budget_s_(most_s_ / kBand) {
  for (std::size_t m = 0; m < kMeanCount; ++m) x_[m] = level_.step[m] + 0.5;
}

double FrameRateControl::reached_fps() const {
  return 1 / (period_s_ * std::max(1.0, cost_s_ / most_s_));
}

void FrameRateControl::record(double begin_s, double cost_s) {
  if (!fresh_) keep(cost_s);
  fresh_ = false;
  cost_s_ = frames_ > 0 ? median_s(kJudged) : cost_s;
  // a frame that began as early or late as the pace jitters moves none of those after it
  const double from_s = std::abs(begin_s - next_s_) <= kJitter * period_s_ ? next_s_ : begin_s;
  next_s_ = from_s + period_s_ * std::max(1.0, cost_s_ / most_s_);
  if (frames_ > 0) judge(begin_s);
}

void FrameRateControl::keep(double cost_s) {
  costs_[frames_ % kKept] = cost_s;
  ++frames_;
}

// Of the newest frames of this level: one that somebody else's work delayed says nothing.
double FrameRateControl::median_s(std::size_t newest) const {
  const std::size_t count = std::min({newest, frames_, kKept});
  std::array<double, kKept> sorted{};
  for (std::size_t k = 0; k < count; ++k) sorted[k] = costs_[(frames_ - 1 - k) % kKept];
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
  return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

bool FrameRateControl::too_dear() const {
  return (frames_ >= kJudged && median_s(kJudged) > (approved_ ? kNear : 1.0) * budget_s_) ||
         (frames_ >= kKept && median_s(kKept) > kBarely * budget_s_);
}

void FrameRateControl::judge(double now_s) {
  const double newest = costs_[(frames_ - 1) % kKept];
  const double before = frames_ > 1 ? costs_[(frames_ - 2) % kKept] : 0;
  const double surely = newest > kLongFrame_s ? newest : std::min(newest, before);
  if (surely > kFar * budget_s_) return coarsen(surely);
  const double median = median_s(kJudged);
  if (trial_) return judge_trial(median, now_s);
  if (too_dear()) return coarsen(median);
  if (frames_ >= kFew && refine_together(median)) return;
  if (frames_ < kJudged) return;
  lift_refusals(median_s(kKept), now_s);
  if (median > budget_s_) return;
  approved_ = true;
  before_trial_s_ = median;
  refine_one();
}

void FrameRateControl::judge_trial(double median, double now_s) {
  const bool sure = frames_ >= kFew && median < kSure * budget_s_;
  if (!sure && frames_ < kJudged) return;
  const std::size_t mean = *trial_;
  trial_.reset();
  if (median <= budget_s_) {
    before_trial_s_ = median;
    return refine_one();
  }
  refused_[mean] = Refusal{std::max(median / before_trial_s_, 1.0), now_s + kRefused_s};
  move(mean, level_.step[mean] - 1);
  begin_level();
}

double FrameRateControl::gain() const {
  return kAlpha * period_s_ * static_cast<double>(std::min<std::size_t>(frames_ + 1, kJudged));
}

void FrameRateControl::coarsen(double cost_s) {
  const PictureLevel before = level_;
  if (trial_) {
    refused_[*trial_] = Refusal{cost_s / before_trial_s_, next_s_ + kRefused_s};
    move(*trial_, level_.step[*trial_] - 1);
    trial_.reset();
  } else {
    const double back = gain() * std::log(cost_s / budget_s_);
    for (std::size_t m = 0; m < kMeanCount; ++m)
      move(m, std::min(static_cast<int>(std::floor(x_[m] - back * kFinestStep[m])), level_.step[m] - 1));
    refused_.fill(std::nullopt);  // the load is another one
    careful_ = true;
    approved_ = false;
  }
  if (level_ != before) begin_level();
}

bool FrameRateControl::refine_together(double median) {
  if (careful_ || kRoom * median > budget_s_) return false;
  const double forth = gain() * std::log(budget_s_ / median);
  const PictureLevel before = level_;
  for (std::size_t m = 0; m < kMeanCount; ++m) {
    if (!open(m)) continue;
    const double x = x_[m] + forth * kFinestStep[m];
    move(m, static_cast<int>(std::floor(x)));
    x_[m] = std::min(x, level_.step[m] + 0.999);
  }
  if (level_ == before) return false;
  approved_ = false;
  begin_level();
  return true;
}

// The one that lags behind most.
void FrameRateControl::refine_one() {
  std::optional<std::size_t> chosen;
  const auto height = [&](std::size_t m) { return static_cast<double>(level_.step[m]) / kFinestStep[m]; };
  for (std::size_t m = 0; m < kMeanCount; ++m)
    if (open(m) && (!chosen || height(m) < height(*chosen))) chosen = m;
  if (!chosen) return;
  trial_ = chosen;
  move(*chosen, level_.step[*chosen] + 1);
  begin_level();
}

void FrameRateControl::lift_refusals(double median, double now_s) {
  for (auto& refusal : refused_) {
    if (!refusal) continue;
    if (refusal->growth * median < kClearly * budget_s_ || now_s > refusal->until_s) refusal.reset();
  }
  if (std::ranges::none_of(refused_, [](const auto& r) { return r.has_value(); })) careful_ = false;
}

bool FrameRateControl::open(std::size_t mean) const {
  return level_.step[mean] < kFinestStep[mean] && !refused_[mean];
}

void FrameRateControl::move(std::size_t mean, int step) {
  level_.step[mean] = std::clamp(step, 0, kFinestStep[mean]);
  x_[mean] = level_.step[mean] + 0.5;
}

void FrameRateControl::begin_level() {
  ++changes_;
  frames_ = 0;
  fresh_ = true;
}

}  // namespace omentum::render
