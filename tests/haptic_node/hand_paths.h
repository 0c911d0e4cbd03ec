// Random ways of a hand through, around and along an organ: continuous, as hands are.
#pragma once

#include "haptic_node/haptic_model.h"

#include <random>

namespace omentum::haptic_test {

/// One tool's way: minimum-jerk moves between waypoints, with rests. Deterministic for a seed on one machine.
class HandPath {
 public:
  static constexpr double kFastest_m_s = 0.4;

  /// Starts outside, lasts `seconds` at least. `turns`: the shaft leans this way and that, else it stays
  /// upright.
  HandPath(const haptic::ElasticSurface& organ, std::uint32_t seed, double seconds, bool turns);

  double duration_s() const { return end_s_; }
  /// The pose at t; before 0 and after the end it rests.
  haptic::ToolFrame at(double t_s) const;

 private:
  struct Move {
    double begin_s, end_s;
    geometry::Vec3 from, to;            // of the tip, m
    geometry::Vec3 lean_from, lean_to;  // the shaft's direction, not unit
  };

  void go(const geometry::Vec3& to);
  void rest();
  void add_episode(const haptic::ElasticSurface& organ);
  geometry::Vec3 anywhere();
  double uniform(double low, double high);

  std::mt19937 random_;
  bool turns_;
  Eigen::AlignedBox3d room_;  // the organ's, with space around
  std::vector<Move> moves_;
  geometry::Vec3 tip_, lean_ = geometry::Vec3::UnitZ();
  double end_s_ = 0;
};

}  // namespace omentum::haptic_test
