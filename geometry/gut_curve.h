// The axis of a folded intestine as a curve, before it is masses.
#pragma once

#include "geometry/types.h"

namespace omentum::geometry {

/// What the curve is made of, m.
struct GutFolds {
  double cylinder_radius_m = 0;
  double pitch_m = 0;  // between legs, along the cylinder's axis
  double vessel_length_m = 0;
  double lead_m = 0;  // of the gut, over which its mesentery takes a wide share of the vessel
  std::int32_t legs = 0;
  double leg_m = 0;  // of a leg, along the cylinder
};

/// Legs around a cylinder, each parted from the next by half a wave of the curve whose direction is a sine of
/// its length (Langbein and Leopold 1966, "River meanders: theory of minimum variance"): there the direction
/// theta against the cylinder's axis is pi/2 cos t, 0 <= t <= pi. The first leg begins at the vessel's end
/// and the last one ends at the other, on spirals that touch the cylinder.
///
/// A place is given by u in [0, length_m()], the length on the cylinder rolled out. In the cylinder's frame:
/// z along the vessel, from its middle; x to the middle of the legs.
class GutCurve {
 public:
  explicit GutCurve(const GutFolds& folds);

  /// The least pitch of turns whose radius is at least bend_radius_m; the curvature is greatest at t = pi/2.
  static double least_pitch(double bend_radius_m);

  /// The first and the last leg hold the way from the vessel to the cylinder.
  static double least_leg(double cylinder_radius_m);

  double length_m() const { return length_; }
  /// To both sides of the middle of the legs, rad: what the turns' ends reach.
  double reach_angle() const;
  Vec3 point(double u) const;
  /// Where on the vessel the mesentery's line from point(u) ends, z in m; grows with u.
  double vessel_z(double u) const;

 private:
  struct Place {
    double radius, angle, z;  // cylinder coordinates
  };
  Place place(double u) const;
  Place first_half(double u) const;
  Place rolled_out(double u) const;

  GutFolds folds_;
  double turn_, length_;
};

}  // namespace omentum::geometry
