#include "device_bridge/hand_way.h"

#include <algorithm>
#include <cmath>

namespace omentum::device {

double way_period_s(const scene::HandSpec& hand) {
  double period_s = 0;
  for (const scene::HandWaypoint& waypoint : hand.way) period_s += waypoint.seconds;
  return period_s;
}

ScriptPoint way_at(const scene::HandSpec& hand, double t_s) noexcept {
  const std::size_t count = hand.way.size();
  double left_s = std::fmod(t_s, way_period_s(hand));
  std::size_t from = 0, to = 1 % count;
  while (to != 0 && left_s >= hand.way[to].seconds) {
    left_s -= hand.way[to].seconds;
    from = to;
    to = (to + 1) % count;
  }
  const scene::HandWaypoint &begin = hand.way[from], &end = hand.way[to];
  const Vec3 way = end.to - begin.to;
  ScriptPoint point;
  point.phase = way.isZero() ? Phase::kHold : Phase::kSlide;
  point.phase_share = std::min(left_s / end.seconds, 1.0);
  const double share = minimum_jerk(point.phase_share);
  point.on_way.position = begin.to + share * way;
  point.on_way.velocity = minimum_jerk_rate(point.phase_share) / end.seconds * way;
  point.grip_rad = begin.grip_rad + share * (end.grip_rad - begin.grip_rad);
  point.roll_rad = begin.roll_rad + share * (end.roll_rad - begin.roll_rad);
  return point;
}

}  // namespace omentum::device
