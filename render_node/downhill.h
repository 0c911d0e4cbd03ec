// The way that a drop takes down a surface of triangles.
#pragma once

#include "geometry/surface.h"
#include "render_node/surface_refinement.h"

#include <map>

namespace omentum::render {

/// A place on a triangle, which moves with its nodes.
using SurfacePoint = SurfaceRefinement::Place;

/// A value of the nodes there.
Vec3f at(const SurfacePoint& point, std::span<const Vec3f> of_nodes);

/// Ways over one surface. It is looked at, not kept: `triangles` and `positions` must outlive this.
class Downhill {
 public:
  /// A slope (sine) on which a drop stays: contact angles of wet tissue hold it there.
  static constexpr float kHolds = 0.25f;

  Downhill(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions);

  /// From a place inside a triangle (`weight` of its corners) down against z for at most `length_m`, or until
  /// the surface no longer slopes, folds back or ends. First the start, then each edge that is crossed, then
  /// where it stays; at most `most` points.
  std::vector<SurfacePoint> way(std::size_t triangle, const Vec3f& weight, float length_m,
                                std::size_t most) const;

 private:
  struct Exit {
    std::size_t edge = 0;  // from this corner to the next
    Vec3f place;
    float length_m = 0;
  };
  Vec3f corner(std::size_t triangle, std::size_t c) const { return positions_[triangles_[triangle][c]]; }
  Vec3f normal(std::size_t triangle) const;  // as long as twice the area
  // Whether what came over this edge of `from` would come back.
  bool folds_back(std::size_t from, std::size_t edge, std::size_t to) const;
  Vec3f slope(std::size_t triangle) const;  // unit where z is steepest downwards, times its sine
  Exit exit(std::size_t triangle, const Vec3f& from, const Vec3f& along) const;
  SurfacePoint point(std::size_t triangle, const Vec3f& place) const;

  std::span<const geometry::Triangle> triangles_;
  std::span<const Vec3f> positions_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>
      on_edge_;  // by its ends, in the triangle's order
};

}  // namespace omentum::render
