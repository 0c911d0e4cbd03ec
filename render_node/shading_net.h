// Normals and openness of one surface, state after state.
#pragma once

#include "render_node/flat_links.h"
#include "render_node/surface_shading.h"

namespace omentum::render {

/// smooth_normals() exactly, and openness_of() nearly, of triangles that stay: who is whose neighbour lies in
/// flat tables, points in fours of floats, and nothing is allocated after it was made. openness_of() averages
/// by k steps D of diffusion, D^k x; this does by the polynomial of D of least degree s that spreads as far
/// and lets no more than kRipple of what is narrower through, a Chebyshev polynomial:
///
///     p(D) = T_s(w_0 + w_1 (D - 1)) / T_s(w_0),   w_0 = cosh a,   w_1 = (1 + w_0) / 2,   p'(1) = k,
///
/// hence s coth(a/2) = 2 k; D has its eigenvalues within -1 and 1. For k = 16, s = 8. How far openness looks
/// is counted in edges at rest, so that no step comes or goes while the surface moves. One thread.
class ShadingNet {
 public:
  ShadingNet() = default;  // without triangles
  /// `rest`: [S], m. `horizon_m`: openness_of()'s.
  ShadingNet(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> rest, float horizon_m);

  /// `positions`, `normals`: [S]. A node without area around it keeps its normal.
  void find_normals(std::span<const Vec3f> positions, std::span<Vec3f> normals);
  /// All [S].
  void find_openness(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                     std::span<float> openness);

 private:
  static constexpr double kRipple = 0.04;
  // z_j+1 = mean D z_j + own z_j - old z_j-1
  struct Step {
    float mean, own, old;
  };
  void plan_steps(int diffusions);
  void average(const Step& step);

  std::vector<geometry::Triangle> triangles_;
  float horizon_m_ = 0;
  std::vector<Step> steps_;
  FlatLinks around_;                           // triangles of nodes
  FlatLinks beside_;                           // and nodes
  std::vector<Eigen::Vector4f> areas_;         // [triangles], vectors; the fourth is 0
  std::vector<Eigen::Vector4f> now_, before_;  // [S], z_j and z_j-1
};

}  // namespace omentum::render
