#include "render_node/feel_ring.h"

#include "render_node/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kRingThickness = 0.055f;  // of its radius
constexpr int kRingSides = 12, kRingSegments = 48;
// shares of the widest ring's radius
constexpr float kBarRight = 1.35f, kBarLength = 2, kBarRadius = 0.09f, kTrackRadius = 0.05f;
const Vec3f kPale{0.55f, 0.78f, 0.80f}, kAmberFeel{1.0f, 0.46f, 0.05f}, kRedFeel{0.95f, 0.03f, 0.02f};
const Vec3f kTrack{0.10f, 0.13f, 0.14f};

// A torus of radius 1 about z.
MeshData unit_ring() {
  std::array<ProfilePoint, kRingSides + 1> profile{};
  for (int k = 0; k <= kRingSides; ++k) {
    // from the inside by the bottom outwards
    const float angle = std::numbers::pi_v<float> * (1 + 2 * static_cast<float>(k) / kRingSides);
    profile[static_cast<std::size_t>(k)] = {1 + kRingThickness * std::cos(angle),
                                            kRingThickness * std::sin(angle)};
  }
  return turned(profile, kRingSegments);
}

Mat4f at(const Vec3f& origin, const Eigen::Matrix3f& axes) {
  Mat4f pose = Mat4f::Identity();
  pose.topLeftCorner<3, 3>() = axes;
  pose.topRightCorner<3, 1>() = origin;
  return pose;
}

Material signal(const Vec3f& colour) {
  return {colour, 0, 1};
}

}  // namespace

float tightness(double share) {
  return static_cast<float>(std::sqrt(std::clamp(share, 0.0, 1.0)));
}

Vec3f feel_colour(double share) {
  const float tight = tightness(share);
  if (tight < 0.5f) return kPale + 2 * tight * (kAmberFeel - kPale);
  return kAmberFeel + (2 * tight - 1) * (kRedFeel - kAmberFeel);
}

FeelRing::FeelRing(Renderer& renderer)
    : ring_(renderer.add_mesh(unit_ring())), bar_(renderer.add_mesh(unit_shaft())) {}

void FeelRing::add(const ToolNow& tool, double limit_n, Frame& frame) const {
  if (!tool.seen) return;
  const Vec3f tip = tool.p_WT.cast<float>();
  const Vec3f in_eye = (frame.view.eye_from_W * tip.homogeneous()).head<3>();
  if (in_eye.z() >= 0) return;  // behind the viewer
  const Eigen::Matrix3f W_from_eye = frame.view.eye_from_W.topLeftCorner<3, 3>().transpose();
  const double share = tool.force_n.norm() / limit_n;
  const float wide = -in_eye.z() * kWide / frame.view.clip_from_eye(1, 1);
  const float radius = wide * (1 + (kTight - 1) * tightness(share));
  const Material felt = signal(feel_colour(share));
  frame.items.push_back({ring_, Look::kSignal, at(tip, radius * W_from_eye), felt});

  // z of the bar's mesh is up in the picture
  const Vec3f right = W_from_eye.col(0), up = W_from_eye.col(1), back = W_from_eye.col(2);
  const Vec3f foot = tip + wide * (kBarRight * right - 0.5f * kBarLength * up);
  const auto add_bar = [&](float thick, float filled, const Material& material) {
    Eigen::Matrix3f axes;
    axes << thick * wide * back, thick * wide * right, filled * kBarLength * wide * up;
    frame.items.push_back({bar_, Look::kSignal, at(foot, axes), material});
  };
  add_bar(kTrackRadius, 1, signal(kTrack));
  if (share > 0) add_bar(kBarRadius, static_cast<float>(std::min(share, 1.0)), felt);
}

}  // namespace omentum::render
