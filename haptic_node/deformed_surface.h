// An organ as the hand touches it: this tick's own superposition, exact wherever a tool can be.
#pragma once

#include "geometry/bucket_grid.h"
#include "haptic_node/body.h"
#include "physics/surface_compliance.h"

namespace omentum::haptic {

/// The organ's surface under the forces of the last solve: x = X + C_:A f_A (Cotin 1999, eq. 9 in force
/// form).
///
/// Clusters of 16 nodes are superposed only when they are looked at. For all others a box of their triangles
/// is kept, together with a bound of how far they moved since it was exact: sum over ticks of sum_k bounds(k)
/// |df_k|. So evaluate(region) finds rigorously every cluster that may have a triangle in the region, at the
/// cost of one dot product per cluster, whatever the mesh's size. Triangles of evaluated clusters are kept in
/// Cotin's bucket grid.
///
/// The surface may be open: what is nearest to its border is outside of it.
///
/// No allocation after construction. One thread at a time. Surface, positions and compliance must outlive it.
class DeformedSurface : public Body {
 public:
  DeformedSurface(const geometry::Surface& surface, std::span<const Vec3> rest,
                  const physics::SurfaceCompliance& compliance, const BodyOrigin& origin = {});

  void restore_rest() noexcept final;
  /// What may follow and that it does in one step.
  void set_forces(std::span<const SurfaceId> nodes, std::span<const Vec3> forces) noexcept {
    propose(nodes, forces);
    accept();
  }
  void propose(std::span<const SurfaceId> nodes, std::span<const Vec3> forces) noexcept final;
  void accept() noexcept final;
  /// Holds for the point's whole triangle.
  double motion_bound(const SurfacePoint& point) const noexcept final;
  Eigen::Matrix3f block(SurfaceId n, SurfaceId k) const noexcept final {
    return compliance_.block(n, k).cast<float>();
  }
  /// Neighbours: of its fan, held ones too.
  double beyond_neighbours(SurfaceId n) const noexcept final;

  /// Makes exact every cluster of which a triangle may be within kReach_m of the region.
  void evaluate(const Region& region) noexcept final;

  /// The node's cluster is evaluated when it was not.
  const Vec3& position(SurfaceId node) noexcept final {
    ensure(node / geometry::kClusterSize);
    return positions_[node];
  }
  Vec3 position(const SurfacePoint& point) noexcept final {
    const geometry::Triangle& t = surface_.triangles[point.triangle];
    const Vec3& k = point.barycentric;
    return k[0] * position(t[0]) + k[1] * position(t[1]) + k[2] * position(t[2]);
  }
  void find_place(const SurfacePoint& point, Place& place) noexcept override;
  Vec3 rest_position(const SurfacePoint& point) const noexcept {
    const geometry::Triangle& t = surface_.triangles[point.triangle];
    const Vec3& k = point.barycentric;
    return k[0] * rest_[t[0]] + k[1] * rest_[t[1]] + k[2] * rest_[t[2]];
  }
  std::optional<SurfacePoint> nearest_at_rest(const Vec3& p, double reach_m) noexcept final;
  double longest_edge(SurfaceId node) const noexcept final { return longest_edge_[node]; }

  /// Rest normals of the triangle's vertices (area-weighted over their fans), interpolated, so that it is
  /// continuous across edges. Of the rest shape on purpose: linear elasticity states equilibrium there, and
  /// under a sharp tool it dips into a funnel one edge wide whose walls are no surface to lean on (with the
  /// normals of the deformed shape forces on a fine mesh flickered between two directions from tick to tick).
  Vec3 normal(const SurfacePoint& point) const noexcept;

  /// Straight in from the point's nearest vertex: the way to the surface on the other side over the thickness
  /// at rest; about 1 while nothing is squeezed, however far the organ is bent. Asked for p beyond where the
  /// other side is at rest only: elsewhere 1, without a look at it.
  double tissue_ahead(const SurfacePoint& point, const Vec3& p) noexcept final;

  /// The first place where the segment p -> q, inside an evaluated region, passes a triangle from outside to
  /// inside. Looks through every bucket that it crosses.
  std::optional<Entry> first_entry(const Vec3& p, const Vec3& q) noexcept;

  /// The nearest material point when p, inside an evaluated region, lies inside the organ, at most `reach_m`
  /// deep.
  std::optional<SurfacePoint> nearest_if_inside(const Vec3& p, double reach_m) noexcept;

  std::optional<Immersion> immersion(const Vec3& p, double reach_m) noexcept final;
  Encounter meet(const Vec3& p, const Vec3& q, double radius_m, bool outside = true) noexcept final;

  double known_motion() const noexcept final { return known_motion_; }
  double entered_motion() const noexcept final { return entered_motion_; }

  /// From triangle to touching triangle: sliding without search.
  SurfacePoint slide(const SurfacePoint& from, const Vec3& p) noexcept final;

  int loaded_nodes() const noexcept final { return static_cast<int>(nodes_.size()); }
  /// Whole clusters.
  int evaluated_nodes() const noexcept final { return evaluated_clusters_ * geometry::kClusterSize; }

  const geometry::Surface& surface() const noexcept { return surface_; }

 protected:
  /// The positions at rest that it refers to have changed, none by more than this, m; between accept() and
  /// evaluate().
  void rest_moved(double most_m) noexcept;

 private:
  // above the rounding of float coordinates within 8 m of W's origin and of superposed displacements, m
  static constexpr float kRounding_m = 1e-6f;

  using Corners = std::array<const Vec3*, 3>;

  // What a proposal changes: nodes, and by how much each one's force, N.
  struct ForceChange {
    std::array<SurfaceId, 2 * kMaxForces> nodes;
    std::array<float, 2 * kMaxForces> sizes_n;
    int count = 0;
  };

  void index_clusters();
  void size_bounds();
  bool is_mobile(SurfaceId node) const noexcept { return node >= 0 && node < surface_.mobile_count; }
  bool fresh(std::int32_t cluster) const noexcept {
    return cluster >= clusters_ || cluster_version_[cluster] == version_;
  }
  bool fresh(TriangleId triangle) const noexcept {
    const geometry::Triangle& t = surface_.triangles[triangle];
    return fresh(t[0] / geometry::kClusterSize) && fresh(t[1] / geometry::kClusterSize) &&
           fresh(t[2] / geometry::kClusterSize);
  }
  void ensure(std::int32_t cluster) noexcept {
    if (!fresh(cluster)) make_exact(cluster);
  }
  void make_exact(std::int32_t cluster) noexcept;
  void superpose(std::int32_t cluster) noexcept;
  void learn_motion(std::int32_t cluster) noexcept;
  void enclose(std::int32_t cluster) noexcept;
  void bin(std::int32_t cluster) noexcept;
  void bin_pending() noexcept;
  template <class Visit>
  void visit_near(const Vec3& p, const Vec3& q, double radius_m, Visit&& visit) noexcept;
  Corners stored_corners(TriangleId triangle) const noexcept;
  void find_normals();
  void find_longest_edges();
  void find_other_side();
  void find_border();
  bool outside_of_feature(const SurfacePoint& nearest, const Vec3& p) noexcept;

  const geometry::Surface& surface_;
  std::span<const Vec3> rest_;
  const physics::SurfaceCompliance& compliance_;
  std::int32_t clusters_;  // of mobile nodes

  // constant: which nodes and triangles hang on a cluster
  std::vector<std::int32_t> outer_start_, outer_;  // nodes of its triangles in other clusters ...
  std::vector<std::int32_t> next_start_, next_;    // ... and these clusters, mobile ones
  std::vector<std::int32_t> owned_start_, owned_;  // triangles binned with it
  std::vector<Vec3> normals_;                      // [S] at rest, unit
  std::vector<double> longest_edge_;               // [S] at rest, m
  std::vector<bool> on_border_;                    // [S] of an open surface
  std::vector<SurfacePoint> other_side_;           // [S] straight in from each node ...
  std::vector<double> thickness_;                  // ... and how far that is at rest, m; infinity: nowhere
  std::vector<double> other_height_;               // ... and its height at rest along the node's normal, m

  std::vector<Vec3> positions_;             // [S] exact when last superposed
  std::vector<float> low_[3], high_[3];     // [clusters] box of all triangles that touch the cluster ...
  std::vector<float> moved_;                // ... and how far these may have moved since
  std::vector<float> moved_since_binning_;  // the same since their buckets were looked at
  std::vector<float> step_;                 // how far they may have moved by the last set_forces
  std::vector<float> motion_;               // how far its own nodes did, where that is known; else step_
  std::vector<std::uint8_t> marks_;
  std::vector<std::int32_t> pending_;           // clusters to evaluate
  std::vector<std::int32_t> unbinned_;          // evaluated ones whose triangles may have left their buckets
  std::vector<std::uint32_t> cluster_version_;  // of the forces it was superposed with
  std::uint32_t version_ = 1;

  std::vector<SurfaceId> nodes_, proposed_nodes_;
  std::vector<Vec3> forces_, proposed_forces_;
  ForceChange change_;
  std::vector<std::int16_t> index_of_;  // [S] position in nodes_, -1
  geometry::BucketGrid grid_;
  double binning_margin_;
  float loosest_;  // a box is drawn anew when its triangles may have left it by more, m
  double known_motion_ = 0, entered_motion_ = 0;
  int evaluated_clusters_ = 0;
  int refreshed_ = 0;
};

}  // namespace omentum::haptic
