// Where a skinned tube has frames: few where it is straight, none where it is folded most.
#pragma once

#include "geometry/tube_axis.h"

namespace omentum::geometry {

/// Parts an axis into pieces, each of which is drawn between two frames (Raghupathi 2004, section 5.1). A
/// segment both of whose masses turn less than eps (TubeAxis::turn_at) is one piece. Any other is cut at
///   m - delta,  m + delta',  delta = (m - u_i) / 3,  delta' = (u_{i+1} - m) / 3       (eq. 11)
/// around its point m of largest curvature. That of a cardinal spline lies at a mass as a rule: there delta
/// is 0, the mass has no frame, and one piece goes over it from the cut before to the cut behind it. So no
/// frame but an end's stands where the axis is folded most, which is what the paper's cuts are for. Keeps its
/// tables, so that it needs no heap. One thread.
class TubeSplit {
 public:
  static constexpr std::size_t kMostCuts = 4;  // of one segment
  static constexpr int kThirds = 3;            // most cuts are at thirds of a segment

  /// For axes of so many masses.
  explicit TubeSplit(std::size_t mass_count);

  /// `eps`: above 0; from 1 on every segment is one piece. `wanted` [segments] or empty: where it is not 0 a
  /// segment is cut at thirds however straight it is, for whoever needs frames there.
  void split(const TubeAxis& axis, double eps, std::span<const std::uint8_t> wanted = {});

  /// Ascending, from 0 to the axis' end.
  std::span<const double> cuts() const { return cuts_; }
  /// [masses] of the axis that was split last.
  std::span<const double> turns() const { return turns_; }

 private:
  void find_peaks(const TubeAxis& axis, double eps);
  void cut(std::size_t segment);

  std::vector<double> turns_;         // [masses]
  std::vector<double> inner_;         // [segments]: where in it the curvature is largest; negative: at a mass
  std::vector<std::uint8_t> peak_;    // [masses]: 1: the largest curvature of a cut segment
  std::vector<std::uint8_t> is_cut_;  // [segments]
  std::vector<double> cuts_;
};

/// Where on a segment the axis' curvature is largest, 0 to 1: 0 or 1 exactly where it is at a mass, as it is
/// as a rule. Found on five places of it and, between them, on the parabola through three.
double sharpest(const AxisCubic& segment);

}  // namespace omentum::geometry
