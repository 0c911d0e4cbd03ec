#include "scene/hand_way_keys.h"

#include <cstdio>
#include <numbers>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

constexpr Range kGrip_rad{.minimum = 0, .maximum = std::numbers::pi / 2};
constexpr Range kRoll_rad{.minimum = -std::numbers::pi, .maximum = std::numbers::pi};
// No surgeon's hand is faster, at the peak of a minimum-jerk move, which is 15/8 of its mean.
constexpr double kFastest_m_s = 5, kPeakOfMean = 15.0 / 8;

HandWaypoint read_waypoint(TomlSection& s) {
  HandWaypoint waypoint;
  s.read("to", waypoint.to, kRequired);
  s.read("seconds", waypoint.seconds, kRequired, kPositive);
  s.read("grip_rad", waypoint.grip_rad, kOptional, kGrip_rad);
  s.read("roll_rad", waypoint.roll_rad, kOptional, kRoll_rad);
  s.refuse_unknown_keys();
  return waypoint;
}

void refuse_too_fast(const HandWaypoint& from, const HandWaypoint& to, const TomlSection& s) {
  const double least_s = kPeakOfMean * (to.to - from.to).norm() / kFastest_m_s;
  if (to.seconds >= least_s) return;
  char found[48], expected[64];
  std::snprintf(found, sizeof found, "%g s", to.seconds);
  std::snprintf(expected, sizeof expected, "at least %.3g s: a hand goes no faster than %g m/s", least_s,
                kFastest_m_s);
  s.refuse("seconds", found, expected);
}

}  // namespace

std::vector<HandWaypoint> read_way(TomlSection& hand) {
  std::vector<HandWaypoint> way;
  std::vector<TomlSection> sections = hand.sections("way");
  for (TomlSection& s : sections) way.push_back(read_waypoint(s));
  for (std::size_t i = 0; i < way.size(); ++i)
    refuse_too_fast(way[(i + way.size() - 1) % way.size()], way[i], sections[i]);
  return way;
}

}  // namespace omentum::scene
