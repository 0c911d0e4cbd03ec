#include "render_node/jaw_shape.h"

#include "render_node/shape_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kJawPi = std::numbers::pi_v<float>;
constexpr auto kLength = static_cast<float>(scene::kJawLength_m);

constexpr float kHair_m = 1e-6f;     // a ring at the very tip would be a point
constexpr float kTip_m = 1e-4f;      // a point so near to the tip makes it round
constexpr float kInside = 0.8f;      // of the radius: points nearer to the middle are of inner faces
constexpr float kFront_m = 5e-4f;    // points so near to it are the blunt tip's
constexpr float kRims_m = 0.00012f;  // between closed jaws and their middle, so that the line is seen

// Teeth: so many, so deep in flat jaws and in the wall of spoons, which is as thin as that at its teeth'
// feet, m: outer and inner side of it are within half a millimetre of the points that it stands for.
constexpr int kTeeth = 10;
constexpr float kToothDepth = 0.00028f, kSpoonTooth = 0.00016f, kWall = 0.00026f;
constexpr float kToothed = 0.82f;  // of the length, from the tip

// At the hinge jaws are narrow, to turn between their cheeks; shares of the radius.
constexpr float kTongueWidth = 0.56f, kTongueHeight = 0.80f, kCheekInside = 0.60f;
constexpr float kBlade_m = 0.0022f;                 // how thick jaws are whose inner faces stand apart
constexpr float kAroundX = 1.35f, kAroundY = 1.2f;  // blunt tips reach so much beyond their points
constexpr int kArc = 9;

float smooth(float from, float to, float x) {
  const float s = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

// Half sizes of the closed pair at a station: along x, in which it opens, and y.
struct Section {
  float height, width;
};
Section section_at(const JawForm& form, float z) {
  const float r = form.radius, behind = smooth(0.45f * kLength, kLength, z);
  Section section{r * (1 - behind * (1 - kTongueHeight)), r * (1 - behind * (1 - kTongueWidth))};
  if (form.round) {
    const float in = std::min(1.0f, z / r), bulge = std::sqrt(std::max(0.0f, 1 - (1 - in) * (1 - in)));
    return {section.height * bulge, section.width * bulge};
  }
  if (form.blades)
    return {std::lerp(form.gap + kBlade_m, section.height, behind),
            std::lerp(kAroundY * form.tip_y, section.width, behind)};
  constexpr float kNarrow = 0.92f;
  const float grown = smooth(0, form.widest_z, z);
  return {std::lerp(kAroundX * form.tip_x, section.height, grown),
          std::lerp(kAroundY * form.tip_y, kNarrow * section.width, grown)};
}

// The outside from one rim to the other, and the inside back.
std::vector<Vec3f> ring_at(const JawForm& form, float side, float z, bool tooth) {
  const auto [height, width] = section_at(form, z);
  const float apart =
      form.blades ? std::lerp(form.gap, kRims_m, smooth(0.45f * kLength, kLength, z)) : form.gap;
  const float rim = std::min(apart, form.blades ? height - 0.5f * kBlade_m : 0.5f * height);
  std::vector<Vec3f> ring;
  for (int a = 0; a <= kArc; ++a) {
    const float angle = kJawPi * static_cast<float>(a) / kArc;
    ring.emplace_back(side * (rim + (height - rim) * std::sin(angle)), side * -width * std::cos(angle), z);
  }
  const float deep = tooth ? 0 : form.hollow ? kSpoonTooth : kToothDepth;
  const float wall = std::min(form.hollow ? kWall + kSpoonTooth - deep : kWall, 0.4f * width);
  const float floor = form.hollow ? std::max(rim + deep, height - wall) : rim + deep;
  for (int a = kArc; a >= 0; --a) {
    const float angle = kJawPi * static_cast<float>(a) / kArc;
    const float bow = form.hollow ? std::sin(angle) : 1.0f;
    ring.emplace_back(side * (rim + deep + std::max(0.0f, floor - rim - deep) * bow),
                      side * -(width - wall) * std::cos(angle), z);
  }
  return ring;
}

// Whether a point stands for the inner face of its jaw.
bool is_inner(const JawForm& form, const Vec3f& p) {
  const float x = std::abs(p.x());
  if (p.z() < kFront_m || x < kTip_m || x > 0.5f * form.radius) return false;
  const float outside =
      form.round && p.z() < form.radius ? (p - Vec3f(0, 0, form.radius)).norm() : p.head<2>().norm();
  return outside < kInside * form.radius;
}

// Whether the points lie on two planes across x: faces that stand apart however far the jaws are closed.
bool are_blades(const std::vector<geometry::Vec3>& points) {
  constexpr std::size_t kFaces = 6;  // three points span a face
  const auto off_first = [&](const geometry::Vec3& p) {
    return std::abs(std::abs(p.x()) - std::abs(points[0].x())) > static_cast<double>(kTip_m);
  };
  return points.size() >= kFaces && std::abs(points[0].x()) > static_cast<double>(kTip_m) &&
         std::ranges::none_of(points, off_first);
}

}  // namespace

JawForm jaw_form(const scene::ToolSpec& tool) {
  JawForm form;
  form.radius = form.widest_z = static_cast<float>(tool.shaft_radius_m);
  float widest = 0;
  form.round = tool.points.empty();
  for (const geometry::Vec3& point : tool.points) {
    const Vec3f p = point.cast<float>();
    const float across = p.head<2>().norm();
    form.round |= p.norm() < kTip_m;
    if (p.z() < kFront_m) {
      form.tip_x = std::max(form.tip_x, std::abs(p.x()));
      form.tip_y = std::max(form.tip_y, std::abs(p.y()));
    }
    if (across > widest) widest = across, form.widest_z = p.z();
  }
  // points of a hemisphere end below its widest place
  if (widest > 0) form.radius = widest;
  if (widest > 0 && form.round && form.widest_z > kFront_m)
    form.radius = std::max(widest, 0.5f * (widest * widest / form.widest_z + form.widest_z));
  form.gap = kRims_m;
  if (are_blades(tool.points)) {
    form.blades = true, form.hollow = false;
    form.gap = static_cast<float>(std::abs(tool.points[0].x()));
    form.radius = static_cast<float>(tool.shaft_radius_m);
    return form;
  }
  for (const geometry::Vec3& point : tool.points) {
    const Vec3f p = point.cast<float>();
    if (!is_inner(form, p)) continue;
    form.gap = form.hollow ? std::abs(p.x()) : std::min(form.gap, std::abs(p.x()));
    form.hollow = false;
  }
  return form;
}

MeshData jaw_mesh(const JawForm& form, float side) {
  constexpr int kStations = 2 * kTeeth + 1;
  std::vector<std::vector<Vec3f>> rings;
  for (int k = 0; k < kStations; ++k) {
    const float along = static_cast<float>(k) / (kStations - 1);
    // stations lie closer at a round tip; teeth have a head and a foot
    const float z = kLength * (form.round ? 0.35f * along * along + 0.65f * along : along);
    const bool tooth = along > kToothed || k % 2 == 0;
    rings.push_back(ring_at(form, side, std::max(z, kHair_m), tooth));
  }
  std::vector<MeshTriangle> cap;
  for (std::uint32_t a = 0; a < kArc; ++a) {
    const std::uint32_t outer = a, inner = 2 * kArc + 1 - a;
    cap.push_back({outer, outer + 1, inner - 1});
    cap.push_back({outer, inner - 1, inner});
  }
  return skin_of_rings(rings, cap, cap);
}

MeshData cheeks_mesh(float radius) {
  const float from = kLength - 0.0032f, to = kLength + 0.0055f;
  MeshData both;
  for (const float side : {1.0f, -1.0f}) {
    std::vector<std::vector<Vec3f>> rings;
    for (const auto& [z, share] : {std::pair{from, 0.72f}, {from + 0.0009f, 1.0f}, {to, 1.0f}}) {
      std::vector<Vec3f> ring;
      const float begin = std::asin(kCheekInside / share);
      for (int a = 0; a <= kArc; ++a) {
        const float angle = begin + (kJawPi - 2 * begin) * static_cast<float>(a) / kArc;
        ring.emplace_back(side * share * radius * std::cos(angle), side * share * radius * std::sin(angle),
                          z);
      }
      rings.push_back(std::move(ring));
    }
    std::vector<MeshTriangle> cap;
    for (std::uint32_t a = 1; a < kArc; ++a) cap.push_back({0, a, a + 1});
    append(skin_of_rings(rings, cap, cap), both);
  }
  return both;
}

MeshData pin_mesh(float radius) {
  Mat4f across = Mat4f::Identity();
  across.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // z of the sleeve along y
  across.topRightCorner<3, 1>() << 0, 0, kLength;
  return moved(across, sleeve(0.26f * radius, -1.03f * radius, 1.03f * radius));
}

}  // namespace omentum::render
