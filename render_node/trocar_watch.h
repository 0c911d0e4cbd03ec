// Whether a device goes through its tool's trocar.
#pragma once

#include "geometry/types.h"

#include <Eigen/Geometry>

#include <optional>

namespace omentum::render {

/// One tool's. What is drawn, and what a scope sees, is the pose that haptic_node feels with: turned through
/// the trocar. How far the measured shaft passed it is told.
class TrocarWatch {
 public:
  explicit TrocarWatch(std::optional<geometry::Vec3> trocar) : trocar_(std::move(trocar)) {}

  /// The orientation to draw, of a tool whose tip is at p_WT, m, and that was measured as q_WT (unit).
  Eigen::Quaterniond follow(const geometry::Vec3& p_WT, const Eigen::Quaterniond& q_WT);
  /// The newest shaft passed the trocar beyond what a port gives, kPlay_m.
  bool misses() const { return miss_m_ > kPlay_m; }
  /// None where the tool has no trocar or was not seen.
  const std::optional<double>& largest_miss_m() const { return largest_m_; }

  /// A wall yields so much, and devices are calibrated no better, m.
  static constexpr double kPlay_m = 0.005;

 private:
  std::optional<geometry::Vec3> trocar_;
  double miss_m_ = 0;
  std::optional<double> largest_m_;
};

}  // namespace omentum::render
