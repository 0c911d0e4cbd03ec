#include "render_node/hook_shape.h"

#include "render_node/shape_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kWireRadius_m = 0.00055f, kNeckRadius_m = 0.0011f;
constexpr int kWireSegments = 12, kBallRings = 14;
constexpr float kOnAxis_m = 5e-4f;  // an edge that begins so near to the axis needs no bend

}  // namespace

MeshData wire_mesh(const scene::ToolSpec& tool) {
  Vec3f near = tool.edge[0].cast<float>(), far = tool.edge[1].cast<float>();
  if (far.z() > near.z()) std::swap(near, far);
  MeshData wire = capsule(near, far, kWireRadius_m, kWireSegments);
  const float off = near.head<2>().norm();
  if (off > kOnAxis_m) append(capsule({0, 0, near.z() + off}, near, kWireRadius_m, kWireSegments), wire);
  return wire;
}

MeshData ball_mesh(float ball_radius, float to) {
  std::vector<ProfilePoint> profile;
  const float neck = std::min(kNeckRadius_m, 0.5f * ball_radius);
  const float end = std::numbers::pi_v<float> - std::asin(neck / ball_radius);
  for (int k = 0; k <= kBallRings; ++k) {
    const float angle = end * static_cast<float>(k) / kBallRings;
    profile.push_back({k == 0 ? 0.0f : ball_radius * std::sin(angle), ball_radius * (1 - std::cos(angle))});
  }
  profile.push_back({neck, to});
  profile.push_back({0, to});
  return turned(profile, kTurnSegments);
}

float ceramic_from(const scene::ToolSpec& tool, float ball_radius) {
  float behind = 2.15f * ball_radius;
  for (const geometry::Vec3& end : tool.edge) behind = std::max(behind, static_cast<float>(end.z()));
  return behind;
}

}  // namespace omentum::render
