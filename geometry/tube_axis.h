// The smooth axis of a tube through its masses, where to sample it, and cross-sections that do not twist.
#pragma once

#include "geometry/types.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// Weights of P_{i-1}, P_i, P_{i+1}, P_{i+2} in the cardinal spline's point at u = i + t, 0 <= t <= 1; the
/// slope at P_i is (P_{i+1} - P_{i-1}) / 2. They sum to 1.
Eigen::Vector4d cardinal_weights(double t);
/// The same of its derivative by u; they sum to 0.
Eigen::Vector4d cardinal_slopes(double t);

/// The point before P_0, on the parabola through P_0, P_1, P_2 (Bessel; Raghupathi 2004, section 5.1).
inline Vec3 ghost_before(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  return 3 * (p0 - p1) + p2;
}

/// A point of an axis, and its derivative by u, m.
struct AxisPoint {
  Vec3 place, slope;
};

/// Of a segment: place(t) = a + b t + c t^2 + d t^3.
struct AxisCubic {
  Vec3 a, b, c, d;
};

/// A uniform cardinal spline through masses: mass i at u = i, ghosts before the first and after the last one.
/// Any thread; set() is alone.
class TubeAxis {
 public:
  /// At least three masses.
  explicit TubeAxis(std::size_t mass_count);

  /// `masses`: as many, in W, m; two may be in one place. No heap.
  void set(std::span<const Vec3> masses);

  double end() const { return static_cast<double>(points_.size() - 3); }
  /// 0 <= u <= end().
  AxisPoint at(double u) const;
  /// From mass `segment` to the next one.
  AxisCubic cubic(std::size_t segment) const;
  /// How sharply the axis turns at a mass: (1 - cos)/2 of the angle between the chords there, ghosts'
  /// included; 0 straight on, 1 straight back (Raghupathi 2004, eq. 10, whose sign contradicts its text; here
  /// as the text has it). 0 where a chord has no length.
  double turn_at(std::size_t mass) const;

 private:
  std::vector<Vec3> points_;  // ghost, masses, ghost
};

/// Where an axis is sampled: densely where it bends. A turn of one radian counts as `bend_m` of length.
/// Keeps its tables, so that a sampling needs no heap. One thread.
class AxisSampling {
 public:
  /// For axes of so many masses.
  AxisSampling(std::size_t mass_count, double bend_m);

  /// Ascending parameters from 0 to the end, between two of which lies the same share of the whole:
  /// integral of |dx| + bend_m |dt|, measured on kPieces chords of each segment; equal steps of u where the
  /// axis has no length. At least two.
  static constexpr int kPieces = 4;
  void place(const TubeAxis& axis, std::span<double> u);

 private:
  void measure(const TubeAxis& axis);

  double bend_m_;
  std::vector<double> sum_;  // up to each chord's end, m
};

/// A cross-section of a tube: where, and three unit vectors: t along the axis, k and b = t x k across. No
/// frame where k is zero.
struct TubeFrame {
  Vec3 origin = Vec3::Zero(), t = Vec3::UnitX(), k = Vec3::Zero(), b = Vec3::Zero();
};

/// The frame at `point` that is not turned about the axis against `before`: k after the smallest rotation
/// that takes one t to the other, t_{j-1} to t_j,
///   k_j = k_{j-1} - (k_{j-1} . t_j) / (1 + t_{j-1} . t_j) (t_{j-1} + t_j)
/// Raghupathi 2004, eq. 12 (b_j = t_j x k_{j-1}, k_j = b_j x t_j) projects k instead, which is the same for
/// frames without a turn between them; between others it turns k about the axis towards the normal of the
/// bend's plane, by up to a quarter of the turn's square: at each fold of a gut a little more. Any direction
/// across where `before` is no frame; where the axis turns straight back k stays.
TubeFrame frame_after(const TubeFrame& before, const AxisPoint& point);

/// Frames at ascending parameters, each frame_after() the one before it. `last_first`: the first one of the
/// same tube's last state, so that nothing swims from state to state; no frame for none. `frames` and `u` are
/// of one size. A place without slope has the direction before it. `speeds`: the axis' slopes there, m; as
/// many, or none where nobody asks. No heap.
void carry_frames(const TubeAxis& axis, std::span<const double> u, const TubeFrame& last_first,
                  std::span<TubeFrame> frames, std::span<double> speeds = {});

}  // namespace omentum::geometry
