#include "geometry/touching_faces.h"

#include "geometry/closest_points.h"

#include <algorithm>
#include <limits>

namespace omentum::geometry {

namespace {

// Faces that lie on each other look apart by more than this: of opposite unit normals the product is -1.
constexpr double kOpposite = -0.5;
// Points on each edge of a triangle at which is asked what lies under it.
constexpr int kPointsOnEdge = 5;

struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t face = 0;
};

class Finder {
 public:
  explicit Finder(const BoundedMesh& of) : of_(of) {
    for (const Triangle& t : of.surface.triangles) {
      const Vec3 &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
      low_.push_back(a.cwiseMin(b).cwiseMin(c));
      high_.push_back(a.cwiseMax(b).cwiseMax(c));
    }
  }

  // Nearer than `within_m`, or at infinity.
  Nearest nearest(const Vec3& p, double within_m = std::numeric_limits<double>::infinity()) const {
    Nearest found;
    double least = within_m * within_m;
    bool is_found = false;
    for (std::size_t f = 0; f < low_.size(); ++f) {
      const Vec3 away = (low_[f] - p).cwiseMax(p - high_[f]).cwiseMax(0.0);
      if (away.squaredNorm() > least) continue;
      const Triangle& t = of_.surface.triangles[f];
      const double squared =
          closest_point_on_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2)).squared_distance;
      if (squared > least || (is_found && squared == least)) continue;
      is_found = true;
      least = squared;
      found = {std::sqrt(squared), f};
    }
    return found;
  }

 private:
  const Vec3& corner(const Triangle& t, std::size_t i) const {
    return of_.mesh.positions[of_.surface.node[t[i]]];
  }

  const BoundedMesh& of_;
  std::vector<Vec3> low_, high_;
};

std::array<Vec3, 3> corners_of(const BoundedMesh& of, TriangleId f) {
  const Triangle& t = of.surface.triangles[f];
  const auto at = [&](std::size_t i) { return of.mesh.positions[of.surface.node[t[i]]]; };
  return {at(0), at(1), at(2)};
}

Vec3 normal_of(const BoundedMesh& of, TriangleId f) {
  const auto [a, b, c] = corners_of(of, f);
  return (b - a).cross(c - a).normalized();
}

bool holds(const TetraMesh& mesh, const Tetrahedron& t, const Vec3& p) {
  std::array<Vec3, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = mesh.positions[t[i]];
  const Vec3 low = v[0].cwiseMin(v[1]).cwiseMin(v[2]).cwiseMin(v[3]);
  const Vec3 high = v[0].cwiseMax(v[1]).cwiseMax(v[2]).cwiseMax(v[3]);
  if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vec3, 4> w = v;
    w[i] = p;
    if (signed_volume(w[0], w[1], w[2], w[3]) < 0) return false;
  }
  return true;
}

}  // namespace

std::vector<TriangleId> faces_on(const BoundedMesh& of, const BoundedMesh& on, double tolerance_m) {
  const Finder finder(on);
  std::vector<bool> is_near(of.surface.node.size());
  for (std::size_t s = 0; s < is_near.size(); ++s)
    is_near[s] = finder.nearest(of.mesh.positions[of.surface.node[s]], tolerance_m).distance_m <= tolerance_m;
  std::vector<TriangleId> found;
  for (std::size_t f = 0; f < of.surface.triangles.size(); ++f) {
    const auto near = [&](SurfaceId s) { return is_near[static_cast<std::size_t>(s)]; };
    if (!std::ranges::all_of(of.surface.triangles[f], near)) continue;
    const auto [a, b, c] = corners_of(of, TriangleId(f));
    const Nearest centre = finder.nearest((a + b + c) / 3, tolerance_m);
    if (centre.distance_m > tolerance_m) continue;
    if (normal_of(of, TriangleId(f)).dot(normal_of(on, TriangleId(centre.face))) < kOpposite)
      found.emplace_back(f);
  }
  return found;
}

std::vector<std::vector<TetId>> behind_of(const BoundedMesh& of, std::span<const TriangleId> triangles,
                                          const BoundedMesh& on) {
  const Finder finder(on);
  std::vector<std::vector<TetId>> behind;
  for (const TriangleId f : triangles) {
    const auto [a, b, c] = corners_of(of, f);
    std::vector<TetId>& found = behind.emplace_back();
    for (int i = 0; i < kPointsOnEdge; ++i) {
      for (int j = 0; i + j < kPointsOnEdge; ++j) {
        // inside, so that what only touches an edge is not met
        const double u = (i + 1.0 / 3) / kPointsOnEdge, v = (j + 1.0 / 3) / kPointsOnEdge;
        const Nearest nearest = finder.nearest(u * a + v * b + (1 - u - v) * c);
        found.push_back(on.surface.tetrahedron[nearest.face]);
      }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return behind;
}

double deepest_inside(const BoundedMesh& of, const BoundedMesh& in) {
  Vec3 low = in.mesh.positions.front(), high = low;
  for (const Vec3& p : in.mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Finder finder(in);
  double deepest = 0;
  for (const NodeId n : of.surface.node) {
    const Vec3& p = of.mesh.positions[n];
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
    if (std::ranges::none_of(in.mesh.tetrahedra, [&](const Tetrahedron& t) { return holds(in.mesh, t, p); }))
      continue;
    deepest = std::max(deepest, finder.nearest(p).distance_m);
  }
  return deepest;
}

}  // namespace omentum::geometry
