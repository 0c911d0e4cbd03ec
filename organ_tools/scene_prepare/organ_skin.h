// An organ's rest surface as somebody sees it who looks for a place to press.
#pragma once

#include "organ/organ.h"

#include <span>
#include <vector>

namespace omentum::scene_prepare {

using geometry::SurfaceId;
using geometry::TriangleId;
using geometry::Vec3;

/// A point of the surface with its outward unit normal, interpolated over the triangle.
struct SkinPoint {
  Vec3 position;
  Vec3 normal;
};

/// Rest surface, normals and distances to the supports. Lengths in m, frame W.
class OrganSkin {
 public:
  explicit OrganSkin(const organ::Organ& organ);

  std::int32_t node_count() const { return surface_.node_count(); }
  bool mobile(SurfaceId s) const { return s < surface_.mobile_count; }
  const Vec3& position(SurfaceId s) const { return positions_[s]; }
  const Vec3& normal(SurfaceId s) const { return normals_[s]; }
  /// To the nearest supported node; the surface's diagonal where nothing is supported.
  double support_distance(SurfaceId s) const { return support_distance_[s]; }
  const Vec3& centre() const { return centre_; }
  const Vec3& support_centre() const { return support_centre_; }
  double diagonal() const { return diagonal_; }

  /// Nodes that are reached over edges without leaving the ball around s. s comes first.
  std::vector<SurfaceId> patch(SurfaceId s, double radius_m) const;
  /// The closest point of the whole mobile surface.
  SkinPoint closest(const Vec3& p) const;
  /// The closest point of the triangles around the nodes of `patch`.
  SkinPoint closest(const Vec3& p, std::span<const SurfaceId> patch) const;
  /// How far the organ goes on below the surface at s, along the inward normal.
  double thickness(const SkinPoint& at) const;

 private:
  struct Candidate {
    double squared_distance;
    SkinPoint point;
  };
  void measure_supports(const organ::Organ& organ);
  void consider(TriangleId triangle, const Vec3& p, Candidate& best) const;

  const geometry::Surface& surface_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> normals_;
  std::vector<double> support_distance_;
  Vec3 centre_, support_centre_;
  double diagonal_;
};

}  // namespace omentum::scene_prepare
