// What is asked of the deformed surface: where a point is, what it met, where it slides.
#include "geometry/closest_points.h"
#include "haptic_node/deformed_surface.h"
#include "haptic_node/surface_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::haptic {
namespace {

Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

double angle_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - corner, v = b - corner;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

// Looks at triangle after triangle for the nearest point to p within a distance.
struct NearestSearch {
  const Vec3& p;
  double squared_m;  // of what was found, else of the reach
  std::optional<SurfacePoint> found{};

  void look_at(TriangleId triangle, const std::array<const Vec3*, 3>& corners) {
    const auto point = geometry::closest_point_on_triangle(p, *corners[0], *corners[1], *corners[2]);
    if (point.squared_distance > squared_m) return;
    squared_m = point.squared_distance;
    found = SurfacePoint{triangle, point.barycentric};
  }
};

// Where the segment p -> q passes the triangle from outside to inside.
std::optional<Entry> entry_through(TriangleId triangle, const std::array<const Vec3*, 3>& corners,
                                   const Vec3& p, const Vec3& q) {
  const auto& [a, b, c] = corners;
  if ((q - p).dot(area_normal(*a, *b, *c)) >= 0) return std::nullopt;
  const auto hit = geometry::intersect_segment_triangle(p, q, *a, *b, *c);
  if (!hit) return std::nullopt;
  return Entry{hit->parameter, {triangle, hit->barycentric}};
}

// The same for the first such triangle ...
struct EntrySearch {
  const Vec3 &p, &q;
  std::optional<Entry> first{};

  void look_at(TriangleId triangle, const std::array<const Vec3*, 3>& corners) {
    const auto entry = entry_through(triangle, corners, p, q);
    if (entry && (!first || entry->parameter < first->parameter)) first = entry;
  }
};

// ... and for the last one.
struct LastEntrySearch {
  const Vec3 &p, &q;
  Entry last{-1, {}};  // none

  void look_at(TriangleId triangle, const std::array<const Vec3*, 3>& corners) {
    const auto entry = entry_through(triangle, corners, p, q);
    if (entry && entry->parameter > last.parameter) last = *entry;
  }
};

}  // namespace

// Queries reach further by the margin, so that a cluster's buckets need a look only when that is used up, and
// then only when somebody asks.
template <class Visit>
void DeformedSurface::visit_near(const Vec3& p, const Vec3& q, double radius_m, Visit&& visit) noexcept {
  bin_pending();
  grid_.visit_segment(p, q, radius_m + binning_margin_, [&](TriangleId triangle) {
    if (fresh(triangle)) visit(triangle);  // others cannot be here: evaluate() looked
  });
}

DeformedSurface::Corners DeformedSurface::stored_corners(TriangleId triangle) const noexcept {
  const geometry::Triangle& t = surface_.triangles[triangle];
  return {&positions_[t[0]], &positions_[t[1]], &positions_[t[2]]};
}

void DeformedSurface::find_normals() {
  normals_.assign(rest_.size(), Vec3::Zero());
  for (const geometry::Triangle& t : surface_.triangles) {
    const Vec3 normal = area_normal(rest_[t[0]], rest_[t[1]], rest_[t[2]]);
    for (const SurfaceId n : t) normals_[n] += normal;
  }
  for (Vec3& normal : normals_) normal.normalize();
}

void DeformedSurface::find_longest_edges() {
  longest_edge_.assign(rest_.size(), 0);
  for (const geometry::Triangle& t : surface_.triangles) {
    for (int v = 0; v < 3; ++v) {
      const SurfaceId from = t[v], to = t[(v + 1) % 3];
      const double edge_m = (rest_[to] - rest_[from]).norm();
      longest_edge_[from] = std::max(longest_edge_[from], edge_m);
      longest_edge_[to] = std::max(longest_edge_[to], edge_m);
    }
  }
}

// Edges of one triangle alone, looked for from both ends.
void DeformedSurface::find_border() {
  on_border_.assign(rest_.size(), false);
  for (const geometry::Triangle& t : surface_.triangles) {
    for (int v = 0; v < 3; ++v) {
      const SurfaceId from = t[v], to = t[(v + 1) % 3];
      const auto has_edge = [&](TriangleId other) {
        const geometry::Triangle& face = surface_.triangles[other];
        return std::ranges::find(face, to) != face.end();
      };
      if (std::ranges::count_if(surface_.triangles_of(from), has_edge) > 1) continue;
      on_border_[static_cast<std::size_t>(from)] = on_border_[static_cast<std::size_t>(to)] = true;
    }
  }
}

void DeformedSurface::find_other_side() {
  Vec3 low = rest_[0], high = rest_[0];
  for (const Vec3& x : rest_) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double across = (high - low).norm();
  for (std::size_t n = 0; n < rest_.size(); ++n) {
    // a ray that leaves the organ enters it when it is walked the other way
    const Vec3 far = rest_[n] - across * normals_[n], near = rest_[n] - kRounding_m * normals_[n];
    LastEntrySearch leaves{far, near};
    grid_.visit_segment(far, near, 0,
                        [&](TriangleId triangle) { leaves.look_at(triangle, stored_corners(triangle)); });
    other_side_.push_back(leaves.last.point);
    thickness_.push_back(leaves.last.parameter >= 0 ? (1 - leaves.last.parameter) * across
                                                    : std::numeric_limits<double>::infinity());
    other_height_.push_back(std::isinf(thickness_[n]) ? 0 : rest_position(other_side_[n]).dot(normals_[n]));
  }
}

double DeformedSurface::tissue_ahead(const SurfacePoint& point, const Vec3& p) noexcept {
  Eigen::Index nearest = 0;
  point.barycentric.maxCoeff(&nearest);
  const SurfaceId n = surface_.triangles[point.triangle][nearest];
  if (std::isinf(thickness_[n])) return 1;
  const double height = p.dot(normals_[n]);
  if (height > other_height_[n]) return 1;
  return (height - position(other_side_[n]).dot(normals_[n])) / thickness_[n];
}

Vec3 DeformedSurface::normal(const SurfacePoint& point) const noexcept {
  const geometry::Triangle& t = surface_.triangles[point.triangle];
  const Vec3& k = point.barycentric;
  const Vec3 sum = k[0] * normals_[t[0]] + k[1] * normals_[t[1]] + k[2] * normals_[t[2]];
  const double length = sum.norm();
  // on a blade two opposite normals may cancel: then the face's own
  return length > 0 ? Vec3(1 / length * sum)
                    : area_normal(rest_[t[0]], rest_[t[1]], rest_[t[2]]).normalized();
}

void DeformedSurface::find_place(const SurfacePoint& point, Place& place) noexcept {
  const geometry::Triangle& t = surface_.triangles[point.triangle];
  place.position = position(point);
  place.rest = rest_position(point);
  place.drift = {};
  place.normal = normal(point);
  place.nodes.count = 0;
  for (int v = 0; v < 3; ++v) {
    if (t[v] >= surface_.mobile_count) continue;
    place.nodes.node[place.nodes.count] = t[v];
    place.nodes.weight[place.nodes.count++] = point.barycentric[v];
  }
}

std::optional<SurfacePoint> DeformedSurface::nearest_at_rest(const Vec3& p, double reach_m) noexcept {
  const auto nearest = grid_.nearest(p, reach_m, rest_);
  if (!nearest) return std::nullopt;
  return SurfacePoint{nearest->triangle, nearest->barycentric};
}

std::optional<Entry> DeformedSurface::first_entry(const Vec3& p, const Vec3& q) noexcept {
  EntrySearch entry{p, q};
  visit_near(p, q, 0, [&](TriangleId triangle) { entry.look_at(triangle, stored_corners(triangle)); });
  return entry.first;
}

std::optional<SurfacePoint> DeformedSurface::nearest_if_inside(const Vec3& p, double reach_m) noexcept {
  NearestSearch nearest{p, reach_m * reach_m};
  visit_near(p, p, reach_m,
             [&](TriangleId triangle) { nearest.look_at(triangle, stored_corners(triangle)); });
  if (nearest.found && outside_of_feature(*nearest.found, p)) return std::nullopt;
  return nearest.found;
}

std::optional<Immersion> DeformedSurface::immersion(const Vec3& p, double reach_m) noexcept {
  for (double reach = std::min(kReach_m, reach_m);; reach = std::min(2 * reach, reach_m)) {
    evaluate({p.array() - reach, p.array() + reach});
    bin_pending();
    if (const auto nearest = grid_.nearest(p, reach, positions_)) {
      const SurfacePoint point{nearest->triangle, nearest->barycentric};
      if (outside_of_feature(point, p)) return std::nullopt;
      return Immersion{point, std::sqrt(nearest->squared_distance)};
    }
    if (reach == reach_m) return std::nullopt;
  }
}

Encounter DeformedSurface::meet(const Vec3& p, const Vec3& q, double radius_m, bool outside) noexcept {
  // what was out of reach before the last step passed over p only if it moved that far
  const double moved = entered_motion_ < kReach_m ? known_motion_ : kReach_m;
  const double reach = std::min(moved, kReach_m - kRounding_m) + kRounding_m;
  NearestSearch around_p{p, reach * reach}, around_q{q, radius_m * radius_m};
  EntrySearch entry{p, q};
  visit_near(p, q, std::max(radius_m, reach), [&](TriangleId triangle) {
    around_p.look_at(triangle, stored_corners(triangle));
    around_q.look_at(triangle, stored_corners(triangle));
    entry.look_at(triangle, stored_corners(triangle));
  });
  Encounter met{std::nullopt, std::sqrt(around_q.squared_m), around_q.found};
  if (met.nearest && !outside_of_feature(*met.nearest, q)) met.nearest.reset();
  if (outside && around_p.found && !outside_of_feature(*around_p.found, p))
    met.touched = around_p.found;
  else if (entry.first)
    met.touched = entry.first->point;
  return met;
}

// The sign of a distance follows from the normal of the face, from the sum of both faces' normals on an edge,
// from their angle-weighted sum at a vertex (Baerentzen and Aanaes 2005).
bool DeformedSurface::outside_of_feature(const SurfacePoint& nearest, const Vec3& p) noexcept {
  const geometry::Triangle& t = surface_.triangles[nearest.triangle];
  std::array<SurfaceId, 3> feature;
  int size = 0;
  for (int v = 0; v < 3; ++v) {
    if (nearest.barycentric[v] > kOnEdge) feature[size++] = t[v];
  }
  if (size == 1 && on_border_[static_cast<std::size_t>(feature[0])]) return true;
  Vec3 normal = Vec3::Zero();
  int faces = 0;
  for (const TriangleId around : surface_.triangles_of(feature[0])) {
    const geometry::Triangle& face = surface_.triangles[around];
    const auto holds = [&](SurfaceId n) { return std::find(face.begin(), face.end(), n) != face.end(); };
    if ((size > 1 && !holds(feature[1])) || (size > 2 && !holds(feature[2]))) continue;
    ++faces;
    const Vec3 face_normal =
        area_normal(position(face[0]), position(face[1]), position(face[2])).normalized();
    double weight = 1;
    if (size == 1) {
      const auto corner = std::find(face.begin(), face.end(), feature[0]) - face.begin();
      weight = angle_at(position(face[corner]), position(face[(corner + 1) % 3]),
                        position(face[(corner + 2) % 3]));
    }
    normal += weight * face_normal;
  }
  const bool on_border = size == 2 && faces == 1;
  return on_border || normal.dot(p - position(nearest)) >= 0;
}

// Two skins may meet that share no nodes, as a hybrid organ's parts: from the rim of the one the way goes on
// over what lies there of the other.
SurfacePoint DeformedSurface::slide(const SurfacePoint& from, const Vec3& p) noexcept {
  const auto closest_on = [&](TriangleId triangle, const Vec3& x) {
    const geometry::Triangle& t = surface_.triangles[triangle];
    return geometry::closest_point_on_triangle(x, position(t[0]), position(t[1]), position(t[2]));
  };
  const auto walk_from = [&](TriangleId triangle) -> SurfacePoint {
    const auto [here, point] = walk_to(surface_, triangle, p, closest_on);
    return {here, point.barycentric};
  };
  SurfacePoint here = walk_from(from.triangle);
  bool inside = here.barycentric.minCoeff() > kOnEdge;
  for (int v = 0; v < 3; ++v) {
    const auto node =
        static_cast<std::size_t>(surface_.triangles[here.triangle][static_cast<std::size_t>(v)]);
    inside |= here.barycentric[v] > kOnEdge && !on_border_[node];
  }
  if (inside) return here;
  const TriangleId beyond = across_seam(surface_, position(here), p, closest_on);
  return beyond.valid() ? walk_from(beyond) : here;
}

}  // namespace omentum::haptic
