// Raghupathi 2004, section 3.1: an intestine and its mesentery, folded so that nothing overlaps.
#pragma once

#include "geometry/gut_shape.h"

namespace omentum::geometry {

/// The numbers of an intestine. Defaults are the paper's where it has them. Its folds lie on a cylinder
/// around the vessel; the paper's "folded sine" of 4 m on 10 cm of axis would be folded far tighter than a
/// tube of 2 cm can be, so the folds are legs around the cylinder with turns between them, and reach along
/// the axis as far as that needs.
struct GutAnatomy {
  double length_m = 4;                  // of the polygon through the masses of the axis; above 0
  double tube_radius_m = 0.02;          // above 0
  double cylinder_radius_m = 0.15;      // the mesentery's width at least; above 2 tube_radius_m
  double vessel_length_m = 0.10;        // straight, on the cylinder's axis; above 0
  double mesentery_thickness_m = 0.01;  // 0 or more
  double fold_pitch_m = 0.05;           // from leg to leg along the axis; at least 2.34 tube_radius_m
  std::int32_t legs = 6;                // runs around the cylinder, 3 or more; how long follows from length_m
  std::int32_t rows = 4;                // of masses across the mesentery, 2 or more
  std::int32_t columns = 100;           // along the gut; their distance is at most fold_pitch_m

  // where it lies, in W
  Vec3 origin = Vec3::Zero();   // the middle of the vessel, m
  Vec3 along = -Vec3::UnitY();  // of the vessel, from the gut's start to its end; not 0
  Vec3 up = Vec3::UnitZ();      // from the vessel to the middle of the legs; not along `along`
};

/// The masses, equally spaced along the axis, length_m together to 1e-9; rows equally spaced between the axis
/// and the vessel. The mesentery is ruled by lines that never cross: along the gut both of a line's ends only
/// go forward. Its first and last line have no length: there the gut comes from the vessel and goes back to
/// it, on a spiral that becomes the first leg. Throws InputError naming the key, its value and what would
/// be possible, for an anatomy that cannot be and for one whose parts would overlap.
GutShape make_gut(const GutAnatomy& anatomy);

}  // namespace omentum::geometry
