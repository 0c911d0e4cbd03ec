#include "render_node/shape_pieces.h"

#include "geometry/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kHalfPi = 0.5f * std::numbers::pi_v<float>;

// A hemisphere's profile from its pole at z = 0, m.
std::vector<ProfilePoint> hemisphere(float radius, int rings) {
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= rings; ++k) {
    const float angle = kHalfPi * static_cast<float>(k) / static_cast<float>(rings);
    profile.push_back({k == 0 ? 0.0f : radius * std::sin(angle), radius * (1 - std::cos(angle))});
  }
  return profile;
}

}  // namespace

const Material kSteel{{0.80f, 0.79f, 0.77f}, 1.0f, 0.22f};
const Material kDarkSteel{{0.46f, 0.46f, 0.47f}, 1.0f, 0.34f};
const Material kInsulation{{0.020f, 0.021f, 0.024f}, 0.0f, 0.30f};
const Material kCeramic{{0.62f, 0.58f, 0.50f}, 0.0f, 0.35f};
const Material kGlass{{0.010f, 0.014f, 0.022f}, 0.0f, 0.08f};

Material painted(const Vec3f& colour) {
  return {colour, 0.0f, 0.4f};
}

MeshData sleeve(float radius, float from, float to) {
  const float edge = std::min(0.12f * radius, 0.25f * (to - from));
  const std::array<ProfilePoint, 6> profile{{{0, from},
                                             {radius - edge, from},
                                             {radius, from + edge},
                                             {radius, to - edge},
                                             {radius - edge, to},
                                             {0, to}}};
  return turned(profile, kTurnSegments);
}

MeshData ring(float radius, float from, float to, float few_width) {
  MeshData mesh = sleeve(radius, from, to);
  const float middle = 0.5f * (from + to), half = 0.5f * std::max(few_width, to - from);
  const std::array<ProfilePoint, 2> outside{{{radius, middle - half}, {radius, middle + half}}};
  const MeshData coarse = turned(outside, kTurnSegments);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), coarse.vertices.begin(), coarse.vertices.end());
  for (const auto& [i, j, k] : coarse.triangles) mesh.few.push_back({first + i, first + j, first + k});
  return mesh;
}

MeshData round_tip(float radius, float to) {
  std::vector<ProfilePoint> profile = hemisphere(radius, 10);
  profile.push_back({radius, to});
  profile.push_back({0, to});
  return turned(profile, kTurnSegments);
}

MeshData capsule(const Vec3f& from, const Vec3f& to, float radius, int segments) {
  constexpr int kRings = 4;
  const Vec3f way = to - from;
  const float length = way.norm();
  std::vector<ProfilePoint> profile = hemisphere(radius, kRings);
  for (int k = kRings; k >= 0; --k)
    profile.push_back({profile[static_cast<std::size_t>(k)].radius,
                       length + 2 * radius - profile[static_cast<std::size_t>(k)].z});
  Mat4f pose = Mat4f::Identity();
  pose.topLeftCorner<3, 3>() =
      geometry::rotation_onto(geometry::Vec3::UnitZ(), way.cast<double>()).toRotationMatrix().cast<float>();
  pose.topRightCorner<3, 1>() = from - radius / length * way;
  return moved(pose, turned(profile, segments));
}

void append(const MeshData& mesh, MeshData& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& [a, b, c] : mesh.triangles) to.triangles.push_back({first + a, first + b, first + c});
  for (const auto& [a, b, c] : mesh.few) to.few.push_back({first + a, first + b, first + c});
}

MeshData moved(const Mat4f& pose, MeshData mesh) {
  for (Vertex& v : mesh.vertices) {
    v.position = (pose * v.position.homogeneous()).head<3>();
    v.normal = pose.topLeftCorner<3, 3>() * v.normal;
    v.rest = v.position;
  }
  return mesh;
}

MeshData skin_of_rings(const std::vector<std::vector<Vec3f>>& rings,
                       const std::vector<MeshTriangle>& first_cap,
                       const std::vector<MeshTriangle>& last_cap) {
  const auto around = static_cast<std::uint32_t>(rings.front().size());
  std::vector<Vec3f> points;
  for (const std::vector<Vec3f>& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  std::vector<MeshTriangle> triangles;
  for (std::uint32_t k = 0; k + 1 < rings.size(); ++k) {
    for (std::uint32_t a = 0; a < around; ++a) {
      const std::uint32_t here = k * around + a, beside = k * around + (a + 1) % around;
      triangles.push_back({here, beside, beside + around});
      triangles.push_back({here, beside + around, here + around});
    }
  }
  const auto last = static_cast<std::uint32_t>(points.size()) - around;
  for (const auto& [a, b, c] : first_cap) triangles.push_back({a, c, b});
  for (const auto& [a, b, c] : last_cap) triangles.push_back({last + a, last + b, last + c});
  return creased(points, triangles);
}

}  // namespace omentum::render
