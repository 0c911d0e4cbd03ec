#include "geometry/sphere_cover.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

namespace omentum::geometry {

namespace {

// In spacings: how deep a centre lies, how far its sphere stands out, and the longest edge of a piece, no
// point of which is farther than that from its middle.
constexpr double kDepth = 0.5, kOverhang = 0.33, kPiece = 0.6;
// Greedy discs overlap: so many spacings squared each, per unit of surface.
constexpr double kOfASphere = 0.5;
// Of the square of its longest edge: a triangle with less area is a line, which its neighbours have as well.
constexpr double kLine = 1e-9;
// Halvings of the depth where no tetrahedron is so deep.
constexpr int kHalvings = 3;

using Corners = std::array<Vec3, 3>;

/// The tetrahedron around a point, by boxes in the order in which they begin along x.
class TetrahedronSearch {
 public:
  explicit TetrahedronSearch(const TetraMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      const Eigen::AlignedBox3d box = box_of(TetId(t));
      begins_.emplace_back(box.min().x(), TetId(t));
      longest_m_ = std::max(longest_m_, box.sizes().x());
    }
    std::ranges::sort(begins_);
  }

  /// The first one of those that have x in them.
  std::optional<TetId> find(const Vec3& x) const {
    std::optional<TetId> found;
    const auto from = std::ranges::lower_bound(begins_, std::pair(x.x() - longest_m_, TetId(0)));
    for (auto next = from; next != begins_.end() && next->first <= x.x(); ++next) {
      const TetId t = next->second;
      if (found && *found < t) continue;
      if (box_of(t).contains(x) && weights_in(t, x).minCoeff() >= 0) found = t;
    }
    return found;
  }

  /// Barycentric coordinates.
  Eigen::Vector4d weights_in(TetId t, const Vec3& x) const {
    const auto& [a, b, c, d] = mesh_.tetrahedra[t];
    const Vec3& origin = mesh_.positions[a];
    Eigen::Matrix3d edges;
    edges << mesh_.positions[b] - origin, mesh_.positions[c] - origin, mesh_.positions[d] - origin;
    const Vec3 along = edges.inverse() * (x - origin);
    return {1 - along.sum(), along[0], along[1], along[2]};
  }

 private:
  Eigen::AlignedBox3d box_of(TetId t) const {
    Eigen::AlignedBox3d box;
    for (const NodeId n : mesh_.tetrahedra[t]) box.extend(mesh_.positions[n]);
    return box;
  }

  const TetraMesh& mesh_;
  std::vector<std::pair<double, TetId>> begins_;
  double longest_m_ = 0;  // of the boxes, along x
};

class Covering {
 public:
  Covering(const TetraMesh& mesh, const Surface& surface, double about)
      : mesh_(mesh), surface_(surface), search_(mesh) {
    double area_m2 = 0;
    for (const Triangle& triangle : surface.triangles) area_m2 += normal(corners_of(triangle)).norm() / 2;
    cover_.spacing_m = std::sqrt(area_m2 / (kOfASphere * about));
  }

  SphereCover make() {
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      const Corners x = corners_of(surface_.triangles[i]);
      if (!is_line(x)) cover(TriangleId(i), x);
    }
    return std::move(cover_);
  }

 private:
  Corners corners_of(const Triangle& t) const {
    const auto at = [&](int i) { return mesh_.positions[surface_.node[t[static_cast<std::size_t>(i)]]]; };
    return {at(0), at(1), at(2)};
  }
  static Vec3 normal(const Corners& x) { return (x[1] - x[0]).cross(x[2] - x[0]); }

  static bool is_line(const Corners& x) {
    const double longest_m2 = std::max({length_m2(x, 0), length_m2(x, 1), length_m2(x, 2)});
    return normal(x).norm() <= kLine * longest_m2;
  }

  // Halves it along its longest edge until the pieces are small.
  void cover(TriangleId triangle, const Corners& x) {
    std::size_t a = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (length_m2(x, i) > length_m2(x, a)) a = i;
    if (length_m2(x, a) <= std::pow(kPiece * cover_.spacing_m, 2)) return cover_piece(triangle, x);
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    const Vec3 middle = (x[a] + x[b]) / 2;
    cover(triangle, {x[a], middle, x[c]});
    cover(triangle, {middle, x[b], x[c]});
  }
  static double length_m2(const Corners& x, std::size_t i) { return (x[(i + 1) % 3] - x[i]).squaredNorm(); }

  void cover_piece(TriangleId triangle, const Corners& x) {
    const bool is_covered = std::ranges::any_of(cover_.spheres, [&](const CoverSphere& sphere) {
      return std::ranges::all_of(x, [&](const Vec3& corner) {
        return (corner - sphere.centre).squaredNorm() <= sphere.radius_m * sphere.radius_m;
      });
    });
    if (!is_covered) add(triangle, (x[0] + x[1] + x[2]) / 3);
  }

  void add(TriangleId triangle, const Vec3& point) {
    const Corners x = corners_of(surface_.triangles[triangle]);
    const Vec3 inward = -normal(x).normalized();
    CoverSphere sphere{.below = triangle, .place = place_in(x, point)};
    double depth_m = kDepth * cover_.spacing_m;
    std::optional<TetId> in;
    for (int i = 0; i <= kHalvings && !in; ++i, depth_m /= 2) {
      sphere.centre = point + depth_m * inward;
      in = search_.find(sphere.centre);
    }
    if (!in) sphere.centre = point;
    sphere.tetrahedron = in.value_or(surface_.tetrahedron[triangle]);
    sphere.weights = search_.weights_in(sphere.tetrahedron, sphere.centre);
    const double deep_m = (sphere.centre - point).norm(), piece_m = kPiece * cover_.spacing_m;
    sphere.radius_m = std::max(deep_m + kOverhang * cover_.spacing_m, std::hypot(deep_m, piece_m));
    cover_.spheres.push_back(sphere);
  }

  static Vec3 place_in(const Corners& x, const Vec3& p) {
    const Vec3 n = normal(x);
    const auto of = [&](const Vec3& b, const Vec3& c) {
      return (b - p).cross(c - p).dot(n) / n.squaredNorm();
    };
    return {of(x[1], x[2]), of(x[2], x[0]), of(x[0], x[1])};
  }

  const TetraMesh& mesh_;
  const Surface& surface_;
  TetrahedronSearch search_;
  SphereCover cover_;
};

}  // namespace

SphereCover cover_with_spheres(const TetraMesh& mesh, const Surface& surface, double about) {
  return Covering(mesh, surface, about).make();
}

}  // namespace omentum::geometry
