#include "render_node/solids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kCreaseCosine = 0.75f;  // 41 degrees: a ball of 12 rings is smooth, a chamfer is an edge
constexpr int kRoundSegments = 28;      // around an arrow or ball: no corner is seen at a few hundred pixels
constexpr float kPi = std::numbers::pi_v<float>;

// The ground reaches this many organ radii out, where the shader has faded it into the background.
constexpr double kGroundRadii = 7;
constexpr int kGroundRings = 40, kGroundSpokes = 72;
constexpr int kFewRings = 4, kFewSpokes = 3;  // of which the coarsest pictures draw every such one
constexpr std::size_t kGroundSamples = 2000;  // 10 ms at start
constexpr double kGroundGap = 0.015;  // of the radius, below the lowest point: no flicker where they touch

}  // namespace

MeshData creased(const std::vector<Vec3f>& points, const std::vector<MeshTriangle>& triangles) {
  std::vector<Vec3f> area(triangles.size());
  std::vector<std::vector<std::uint32_t>> around(points.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    area[t] = (points[b] - points[a]).cross(points[c] - points[a]);
    for (const auto corner : triangles[t]) around[corner].push_back(t);
  }
  MeshData mesh;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (area[t].isZero(0)) continue;  // collapsed at a pole
    MeshTriangle out{};
    for (int c = 0; c < 3; ++c) {
      const auto corner = triangles[t][c];
      Vec3f normal = Vec3f::Zero();
      for (const auto other : around[corner]) {
        if (area[other].isZero(0)) continue;
        if (area[other].normalized().dot(area[t].normalized()) > kCreaseCosine) normal += area[other];
      }
      out[c] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({points[corner], normal.normalized(), points[corner], 1.0f});
    }
    mesh.triangles.push_back(out);
  }
  return mesh;
}

MeshData turned(std::span<const ProfilePoint> profile, int segments) {
  // points on the axis are one point each, so that their normals come out smooth
  std::vector<Vec3f> points;
  std::vector<std::vector<std::uint32_t>> ring(profile.size());
  for (std::size_t k = 0; k < profile.size(); ++k) {
    for (int s = 0; s < segments; ++s) {
      if (profile[k].radius > 0 || s == 0) {
        const float angle = 2 * kPi * static_cast<float>(s) / static_cast<float>(segments);
        points.emplace_back(profile[k].radius * std::cos(angle), profile[k].radius * std::sin(angle),
                            profile[k].z);
      }
      ring[k].push_back(static_cast<std::uint32_t>(points.size()) - 1);
    }
  }
  std::vector<MeshTriangle> triangles;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    for (int s = 0; s < segments; ++s) {
      const int next = (s + 1) % segments;
      const auto a = ring[k][s], b = ring[k][next], c = ring[k + 1][next], d = ring[k + 1][s];
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return creased(points, triangles);
}

MeshData unit_shaft() {
  const std::array<ProfilePoint, 4> profile{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  return turned(profile, kRoundSegments);
}

MeshData unit_head() {
  const std::array<ProfilePoint, 3> profile{{{0, 0}, {1, 0}, {0, 1}}};
  return turned(profile, kRoundSegments);
}

MeshData unit_ball() {
  constexpr int kRings = 14;
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= kRings; ++k) {
    const float angle = kPi * static_cast<float>(k) / kRings;
    profile.push_back({k == 0 || k == kRings ? 0.0f : std::sin(angle), -std::cos(angle)});
  }
  return turned(profile, kRoundSegments);
}

std::vector<float> light_left(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                              double surface_area_m2, std::size_t samples, std::span<const Vertex> to_all) {
  const std::size_t stride = std::max<std::size_t>(1, surface_positions.size() / samples);
  const auto element = static_cast<float>(surface_area_m2 * static_cast<double>(stride) /
                                          static_cast<double>(surface_positions.size()));
  const auto count = static_cast<Eigen::Index>((surface_positions.size() + stride - 1) / stride);
  Eigen::Array3Xf place(3, count), normal(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    place.col(i) = surface_positions[static_cast<std::size_t>(i) * stride].cast<float>();
    normal.col(i) = normals[static_cast<std::size_t>(i) * stride];
  }
  std::vector<float> left;
  for (const Vertex& vertex : to_all) {
    const Eigen::Array3Xf to = place.colwise() - vertex.position.array();
    const Eigen::ArrayXf squared = to.square().colwise().sum();
    const Eigen::ArrayXf facing = (-(normal * to).colwise().sum()).max(0);
    const Eigen::ArrayXf above = (vertex.normal.transpose() * to.matrix()).transpose().array().max(0);
    const Eigen::ArrayXf hidden = facing * above * element / (squared * (kPi * squared + element));
    left.push_back(std::clamp(1 - hidden.sum(), 0.0f, 1.0f));
  }
  return left;
}

void shade_ground(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                  double surface_area_m2, std::size_t samples, MeshData& ground) {
  const std::vector<float> left =
      light_left(surface_positions, normals, surface_area_m2, samples, ground.vertices);
  for (std::size_t v = 0; v < left.size(); ++v) ground.vertices[v].openness = left[v];
}

MeshData ground_under(std::span<const Vec3> surface_positions, std::span<const Vec3f> normals,
                      const Ball& ball, double surface_area_m2, std::optional<double> height_m) {
  double lowest = ball.centre.z();
  for (const Vec3& p : surface_positions) lowest = std::min(lowest, p.z());
  const double below = lowest - kGroundGap * ball.radius;
  const Vec3 middle(ball.centre.x(), ball.centre.y(), std::min(height_m.value_or(below), below));

  MeshData mesh;
  const auto add = [&](double radius, double angle) {
    const Vec3 g = middle + radius * Vec3(std::cos(angle), std::sin(angle), 0);
    const Vec3f p = g.cast<float>();
    mesh.vertices.push_back({p, Vec3f::UnitZ(), ((g - middle) / ball.radius).cast<float>()});
  };
  add(0, 0);
  for (int k = 1; k <= kGroundRings; ++k) {
    const double share = static_cast<double>(k) / kGroundRings;  // rings lie closer where the organ is
    const double radius = kGroundRadii * ball.radius * (0.3 * share + 0.7 * share * share * share);
    for (int s = 0; s < kGroundSpokes; ++s) add(radius, 2 * std::numbers::pi * s / kGroundSpokes);
  }
  const auto at = [](int ring, int spoke) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kGroundSpokes + spoke % kGroundSpokes);
  };
  for (int s = 0; s < kGroundSpokes; ++s) {
    mesh.triangles.push_back({0, at(1, s), at(1, s + 1)});
    for (int k = 1; k < kGroundRings; ++k) {
      mesh.triangles.push_back({at(k, s), at(k + 1, s), at(k + 1, s + 1)});
      mesh.triangles.push_back({at(k, s), at(k + 1, s + 1), at(k, s + 1)});
    }
  }
  for (int s = 0; s < kGroundSpokes; s += kFewSpokes) {
    const int next = s + kFewSpokes;
    mesh.few.push_back({0, at(kFewRings, s), at(kFewRings, next)});
    for (int k = kFewRings, out = 2 * kFewRings; out <= kGroundRings; k = out, out += kFewRings) {
      mesh.few.push_back({at(k, s), at(out, s), at(out, next)});
      mesh.few.push_back({at(k, s), at(out, next), at(k, next)});
    }
  }
  shade_ground(surface_positions, normals, surface_area_m2, kGroundSamples, mesh);
  return mesh;
}

}  // namespace omentum::render
