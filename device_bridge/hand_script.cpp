#include "device_bridge/hand_script.h"

#include "device_bridge/hand_way.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omentum::device {
namespace {

// A move of one coordinate within a phase; before `begin` (share of the phase) it waits.
struct Move {
  double from_m, to_m;
  double begin = 0;
};

struct PhasePlan {
  Phase phase;
  double duration_s;
  Move height, slide;
};

std::array<PhasePlan, 6> plan_of(const scene::HandSpec& h) {
  const Move none{0, 0};
  const Move above{h.hover_m, h.hover_m}, below{-h.depth_m, -h.depth_m};
  return {{{Phase::kStart, h.start_s, above, none},
           {Phase::kApproach, h.approach_s, {h.hover_m, 0}, none},
           {Phase::kPress, h.press_s, {0, -h.depth_m}, none},
           {Phase::kHold, h.hold_s, below, none},
           {Phase::kSlide, h.slide_s, below, {0, h.slide_m}},
           {Phase::kRelease, h.release_s, {-h.depth_m, h.hover_m}, {h.slide_m, 0, 0.5}}}};
}

// Position and velocity of a move at `share` of a phase of `duration_s`.
void evaluate(const Move& move, double share, double duration_s, double& position, double& rate) {
  const double span = 1 - move.begin;
  const double s = (share - move.begin) / span;
  const double way = move.to_m - move.from_m;
  position = move.from_m + way * minimum_jerk(s);
  rate = way * minimum_jerk_rate(s) / (span * duration_s);
}

}  // namespace

double minimum_jerk(double s) noexcept {
  s = std::clamp(s, 0.0, 1.0);
  // rounding may carry it past its end by the last digit
  return std::min(s * s * s * (10 + s * (-15 + 6 * s)), 1.0);
}

double minimum_jerk_rate(double s) noexcept {
  s = std::clamp(s, 0.0, 1.0);
  return 30 * s * s * (1 - s) * (1 - s);
}

double script_period_s(const scene::HandSpec& hand) {
  if (!hand.way.empty()) return way_period_s(hand);
  double period_s = 0;
  for (const PhasePlan& phase : plan_of(hand)) period_s += phase.duration_s;
  return period_s;
}

ScriptPoint script_at(const scene::HandSpec& hand, double t_s) noexcept {
  if (!hand.way.empty()) return way_at(hand, t_s);
  double left_s = std::fmod(t_s, script_period_s(hand));
  const auto plan = plan_of(hand);
  // rounding may leave a hair more than all phases take: that is the end of the last one
  const PhasePlan* phase = &plan.back();
  for (const PhasePlan& candidate : plan) {
    phase = &candidate;
    if (left_s < candidate.duration_s) break;
    if (&candidate != &plan.back()) left_s -= candidate.duration_s;
  }
  ScriptPoint point;
  point.phase = phase->phase;
  point.phase_share = std::min(left_s / phase->duration_s, 1.0);
  evaluate(phase->height, point.phase_share, phase->duration_s, point.height_m, point.height_rate_m_s);
  evaluate(phase->slide, point.phase_share, phase->duration_s, point.slide_m, point.slide_rate_m_s);
  return point;
}

Motion target_of(const scene::HandSpec& hand, const ScriptPoint& point) noexcept {
  if (!hand.way.empty()) return point.on_way;
  const Vec3 press_point(hand.press_point.data()), normal(hand.press_normal.data()),
      slide(hand.slide_direction.data());
  return {press_point + normal * point.height_m + slide * point.slide_m,
          normal * point.height_rate_m_s + slide * point.slide_rate_m_s};
}

}  // namespace omentum::device
