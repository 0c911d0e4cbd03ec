// A tube that folds itself, and the way of drawing it that skinning is compared with.
#pragma once

#include "render_node/renderer.h"
#include "render_node/tube_frames.h"

namespace omentum::render::trial {

/// Of a small bowel, m; masses of the trial's axis are twice as far apart.
inline constexpr double kRadius_m = 0.02;

/// Masses of an axis in a plane: legs that lie in a row at `folded` = 0 and zigzag towards 1, where a leg
/// goes back along the one before it but for 36 degrees. Every other fold is at one mass, the rest over
/// three.
std::vector<geometry::Vec3> folding_axis(std::size_t masses, double folded);

/// The standard tessellation (Raghupathi 2004, fig. 3 and 11a): sections across a cardinal spline at equal
/// steps of its parameter, joined in order, whatever way they lie to each other.
class BruteSweep {
 public:
  BruteSweep(std::size_t masses, std::size_t sections_of_segment);

  void deform(std::span<const geometry::Vec3> masses);
  /// Light from all around, of the same places as a skinned tube's: for pictures.
  void shade(FoldShade shade);

  const MeshData& mesh() const { return mesh_; }
  std::span<const geometry::TubeFrame> sections() const { return frames_; }

 private:
  geometry::TubeAxis axis_;
  std::vector<double> u_;
  std::vector<geometry::TubeFrame> frames_;
  MeshData mesh_;
};

/// Triangles with an area that face away from the normal of one of their corners: the wall is inside out.
std::size_t turned_inside_out(const MeshData& mesh);

}  // namespace omentum::render::trial
