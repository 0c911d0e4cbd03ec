#include "hand_paths.h"

#include "device_bridge/hand_script.h"
#include "geometry/rotation.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic_test {
namespace {

using geometry::SurfaceId;
using geometry::Vec3;

constexpr double kSpace_m = 0.04;  // around the organ
constexpr double kRest_s = 0.2;
constexpr double kSlowest_m_s = 0.05;
constexpr double kLean = 0.7;  // of the shaft, beside its length
// Peak over mean speed of a minimum-jerk move.
constexpr double kPeak = 1.875;

}  // namespace

HandPath::HandPath(const haptic::ElasticSurface& organ, std::uint32_t seed, double seconds, bool turns)
    : random_(seed), turns_(turns) {
  for (const Vec3& p : organ.rest) room_.extend(p);
  room_.min() -= Vec3::Constant(kSpace_m), room_.max() += Vec3::Constant(kSpace_m);
  tip_ = anywhere();
  tip_.z() = room_.max().z();
  while (end_s_ < seconds) add_episode(organ);
}

double HandPath::uniform(double low, double high) {
  // the library's distributions differ between machines
  return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
}

Vec3 HandPath::anywhere() {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = uniform(room_.min()[i], room_.max()[i]);
  return p;
}

void HandPath::go(const Vec3& to) {
  const double speed = uniform(kSlowest_m_s, kFastest_m_s);
  const Vec3 lean = turns_ ? Vec3(uniform(-kLean, kLean), uniform(-kLean, kLean), 1) : lean_;
  const double takes_s = std::max(kPeak * (to - tip_).norm() / speed, 0.05);
  moves_.push_back({end_s_, end_s_ + takes_s, tip_, to, lean_, lean});
  end_s_ += takes_s;
  tip_ = to;
  lean_ = lean;
}

void HandPath::rest() {
  end_s_ += kRest_s;
}

// Through the organ, in and out again, along its skin, or anywhere; sometimes with a rest on the way.
void HandPath::add_episode(const haptic::ElasticSurface& organ) {
  const auto pick = [&] {
    return organ.rest[random_() % static_cast<std::uint32_t>(organ.surface.mobile_count)];
  };
  const Vec3 middle = room_.center(), skin = pick();
  const Vec3 out = (skin - middle).normalized();
  const bool rests = random_() % 3 == 0;
  switch (random_() % 4) {
    case 0: {  // straight through a point of the skin, and on
      const Vec3 start = anywhere();
      go(start);
      go(skin + (skin - start) * uniform(0.2, 1));
      break;
    }
    case 1: {  // in, and back where it came from
      const Vec3 above = skin + out * uniform(0.01, 0.04);
      go(above);
      go(skin - out * uniform(0.005, 0.06));
      if (rests) rest();
      go(above);
      break;
    }
    case 2: {  // along the skin, a little below it
      const double depth = uniform(0.001, 0.01);
      go(skin + out * 0.01);
      go(skin - out * depth);
      for (int i = 0; i < 3; ++i) {
        const Vec3 next = pick();
        const Vec3 way = next - tip_;
        go(tip_ + way * std::min(1.0, 0.03 / way.norm()));
        if (rests) rest();
      }
      break;
    }
    default:
      go(anywhere());
      if (rests) rest();
  }
}

haptic::ToolFrame HandPath::at(double t_s) const {
  const auto after = std::upper_bound(moves_.begin(), moves_.end(), t_s,
                                      [](double t, const Move& move) { return t < move.begin_s; });
  const Move& move = after == moves_.begin() ? moves_.front() : *std::prev(after);
  const double share = device::minimum_jerk((t_s - move.begin_s) / (move.end_s - move.begin_s));
  const Vec3 lean = move.lean_from + (move.lean_to - move.lean_from) * share;
  return {move.from + (move.to - move.from) * share, geometry::rotation_onto(Vec3::UnitZ(), lean)};
}

}  // namespace omentum::haptic_test
