#include "render_node/downhill.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::render {

Vec3f at(const SurfacePoint& point, std::span<const Vec3f> of_nodes) {
  Vec3f sum = Vec3f::Zero();
  for (int c = 0; c < 3; ++c) sum += point.weight[c] * of_nodes[static_cast<std::size_t>(point.node[c])];
  return sum;
}

Downhill::Downhill(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> positions)
    : triangles_(triangles), positions_(positions) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      on_edge_[{std::int32_t{triangles[t][c]}, std::int32_t{triangles[t][(c + 1) % 3]}}] = t;
}

std::vector<SurfacePoint> Downhill::way(std::size_t triangle, const Vec3f& weight, float length_m,
                                        std::size_t most) const {
  Vec3f place = Vec3f::Zero();
  for (std::size_t c = 0; c < 3; ++c) place += weight[static_cast<int>(c)] * corner(triangle, c);
  std::vector<SurfacePoint> way{point(triangle, place)};
  while (way.size() < most && length_m > 0) {
    const Vec3f down = slope(triangle);
    const float steep = down.norm();
    if (steep < kHolds) break;
    const Exit out = exit(triangle, place, down / steep);
    if (!(out.length_m < length_m)) {
      way.push_back(point(triangle, place + length_m / steep * down));
      break;
    }
    const auto beyond = on_edge_.find({std::int32_t{triangles_[triangle][(out.edge + 1) % 3]},
                                       std::int32_t{triangles_[triangle][out.edge]}});
    way.push_back(point(triangle, out.place));
    if (beyond == on_edge_.end()) break;
    place = out.place;
    length_m -= out.length_m;
    if (folds_back(triangle, out.edge, beyond->second)) break;  // the drop stays in the fold
    triangle = beyond->second;
  }
  return way;
}

Vec3f Downhill::normal(std::size_t triangle) const {
  return (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
}

bool Downhill::folds_back(std::size_t from, std::size_t edge, std::size_t to) const {
  const Vec3f along = corner(from, (edge + 1) % 3) - corner(from, edge);
  return slope(to).dot(along.cross(normal(to))) < 0;
}

Vec3f Downhill::slope(std::size_t triangle) const {
  const Vec3f area = normal(triangle);
  if (!(area.norm() > 0)) return Vec3f::Zero();
  const Vec3f n = area.normalized();
  return -Vec3f::UnitZ() + n.z() * n;
}

// Through the first edge that the way meets; those that it leaves behind do not count.
Downhill::Exit Downhill::exit(std::size_t triangle, const Vec3f& from, const Vec3f& along) const {
  const Vec3f area = normal(triangle);
  Exit first{0, from, std::numeric_limits<float>::infinity()};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3f a = corner(triangle, c), outwards = (corner(triangle, (c + 1) % 3) - a).cross(area);
    const float speed = along.dot(outwards);
    if (speed <= 0) continue;
    const float length_m = std::max(0.0f, (a - from).dot(outwards) / speed);
    if (length_m < first.length_m) first = {c, from + length_m * along, length_m};
  }
  return first;
}

SurfacePoint Downhill::point(std::size_t triangle, const Vec3f& place) const {
  const Vec3f a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
  const Vec3f area = normal(triangle);
  const float squared = area.squaredNorm();
  Vec3f weight = Vec3f::UnitX();
  if (squared > 0) {
    weight = Vec3f((c - b).cross(place - b).dot(area), (a - c).cross(place - c).dot(area),
                   (b - a).cross(place - a).dot(area)) /
             squared;
    weight = weight.cwiseMax(0.0f);
    weight /= weight.sum();
  }
  const geometry::Triangle& t = triangles_[triangle];
  return {{std::int32_t{t[0]}, std::int32_t{t[1]}, std::int32_t{t[2]}}, weight};
}

}  // namespace omentum::render
