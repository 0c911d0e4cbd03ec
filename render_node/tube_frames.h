// From the masses of a gut's axis to the frames that its wall is skinned on.
#pragma once

#include "geometry/tube_split.h"
#include "render_node/fold_shade.h"
#include "render_node/tube_pallor.h"
#include "render_node/tube_resolution.h"

#include <optional>

namespace omentum::render {

/// All that the processor does for a tube in a picture: a spline through the masses, stations on it whose
/// directions across are carried from the first one on, its pieces, light from all around and pallor.
/// Stations are the same whichever pieces there are, so that nothing turns on the wall when a piece is cut.
/// No heap after the first state. One thread.
class TubeFrames {
 public:
  /// `rest`: places of the axis' masses, at least three, in W, m. Where they stand more closely than a spline
  /// of the tube's width needs, some only are control points.
  TubeFrames(std::span<const geometry::Vec3> rest, double radius_m);

  /// As many masses as at rest.
  void deform(std::span<const geometry::Vec3> masses);
  /// `shares`: of the map's scale at each of those masses (tissue_map.h), from the next state on.
  void map(std::span<const float> shares);
  /// `dt_s` go by under these presses of its wall. Whether it is paler or redder now.
  bool live(std::span<const Press> presses, double dt_s);
  /// Where it is cut, from now on; within kCoarsestTubeEps and kFinestTubeEps.
  void set_eps(double eps);

  std::span<const SkinFrame> frames() const { return frames_; }
  const FoldShade& shade() const { return shade_; }
  double eps() const { return eps_; }
  float radius_m() const { return static_cast<float>(radius_m_); }
  /// Along its masses.
  double length_m() const { return length_m_; }
  double rest_length_m() const { return rest_at_.back(); }

 private:
  void write_frames();
  geometry::TubeFrame frame_at(double u, double& speed) const;
  void want_pale_frames();
  void write_pallor();
  void write(const geometry::TubeFrame& frame, double u);
  void bend();

  double radius_m_;
  std::size_t stride_;  // masses from one control point to the next
  double eps_ = TubeResolution{}.eps;
  double length_m_ = 0;
  std::vector<double> rest_at_;         // [control points]: length along the gut at rest, m
  std::vector<float> shares_;           // [control points]
  std::vector<geometry::Vec3> points_;  // [control points]
  geometry::TubeAxis axis_;
  geometry::TubeSplit split_;
  std::vector<double> u_, speeds_;  // [stations]
  std::vector<geometry::TubeFrame> stations_;
  FoldShade shade_;
  std::optional<TubePallor> pallor_;  // made when the stations first stand
  std::vector<std::uint8_t> pale_;    // [segments]
  std::vector<SkinFrame> frames_;
};

}  // namespace omentum::render
