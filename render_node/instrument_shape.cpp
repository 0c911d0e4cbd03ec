#include "render_node/instrument_shape.h"

#include "render_node/solids.h"

#include <array>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr int kSegments = 32;
constexpr float kPi = std::numbers::pi_v<float>;

const Material kSteel{{0.78f, 0.77f, 0.75f}, 1.0f, 0.24f};
const Material kDarkSteel{{0.40f, 0.40f, 0.41f}, 1.0f, 0.38f};
const Material kInsulation{{0.020f, 0.021f, 0.024f}, 0.0f, 0.30f};

constexpr auto kJawLength = static_cast<float>(scene::kJawLength_m);
constexpr int kTeeth = 11;
constexpr float kToothDepth = 0.00028f;  // m
constexpr float kJawGap = 0.00012f;      // m, between closed jaws, so that the line between them is seen
constexpr float kBandLength = 0.005f;    // m
constexpr float kMarkSpacing = 0.01f;    // m: the probe is a ruler too
constexpr float kMarkWidth = 0.0007f;    // m

Material painted(const Vec3f& colour) {
  return {colour, 0.0f, 0.4f};
}

// A cylinder about z with slightly broken edges.
MeshData sleeve(float radius, float from, float to) {
  const float edge = std::min(0.12f * radius, 0.25f * (to - from));
  const std::array<ProfilePoint, 6> profile{{{0, from},
                                             {radius - edge, from},
                                             {radius, from + edge},
                                             {radius, to - edge},
                                             {radius - edge, to},
                                             {0, to}}};
  return turned(profile, kSegments);
}

void append(const MeshData& mesh, MeshData& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& [a, b, c] : mesh.triangles) to.triangles.push_back({first + a, first + b, first + c});
}

MeshData round_tip(float radius, float to) {
  constexpr int kRings = 12;
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= kRings; ++k) {
    const float angle = 0.5f * kPi * static_cast<float>(k) / kRings;
    profile.push_back({k == 0 ? 0.0f : radius * std::sin(angle), radius * (1 - std::cos(angle))});
  }
  profile.push_back({radius, to});
  profile.push_back({0, to});
  return turned(profile, kSegments);
}

// One jaw on the +x side: half-round outside, toothed flat inside, thinner and narrower towards the tip.
MeshData jaw(float shaft_radius, float side) {
  constexpr int kArc = 10;
  constexpr int kStations = 2 * kTeeth + 1;
  std::vector<Vec3f> points;
  for (int k = 0; k < kStations; ++k) {
    const float along = static_cast<float>(k) / (kStations - 1);  // 0 at the tip, 1 at the hinge
    const float rounding = std::sqrt(1 - std::pow(1 - std::min(1.0f, along / 0.16f), 2.0f));
    const float width = shaft_radius * (0.55f + 0.37f * along) * (0.25f + 0.75f * rounding);
    const float height = shaft_radius * (0.42f + 0.5f * along) * (0.2f + 0.8f * rounding);
    const float inside = kJawGap + (k % 2 == 0 ? kToothDepth : 0.0f) * (along < 0.8f ? 1.0f : 0.0f);
    for (int a = 0; a <= kArc; ++a) {
      const float angle = kPi * static_cast<float>(a) / kArc;
      const float x = inside + std::sin(angle) * std::max(height - inside, 0.0f);
      points.emplace_back(side * x, side * -width * std::cos(angle), along * kJawLength);
    }
  }
  std::vector<MeshTriangle> triangles;
  const auto at = [](int station, int a) {
    return static_cast<std::uint32_t>(station * (kArc + 1) + a % (kArc + 1));
  };
  for (int k = 0; k + 1 < kStations; ++k) {
    for (int a = 0; a <= kArc; ++a) {  // the last one is the flat inside
      triangles.push_back({at(k, a), at(k, a + 1), at(k + 1, a + 1)});
      triangles.push_back({at(k, a), at(k + 1, a + 1), at(k + 1, a)});
    }
  }
  for (int a = 1; a < kArc; ++a) {  // caps
    triangles.push_back({at(0, 0), at(0, a + 1), at(0, a)});
    triangles.push_back({at(kStations - 1, 0), at(kStations - 1, a), at(kStations - 1, a + 1)});
  }
  return creased(points, triangles);
}

std::vector<InstrumentPart> grasper(float radius, float length, const Vec3f& band) {
  const float clevis = kJawLength + 0.004f, sleeve_from = kJawLength + 0.009f;
  std::vector<InstrumentPart> parts;
  parts.push_back({jaw(radius, 1), kSteel, 1, kJawLength});
  parts.push_back({jaw(radius, -1), kSteel, -1, kJawLength});
  parts.push_back({sleeve(0.86f * radius, kJawLength - 0.0015f, clevis), kDarkSteel, 0, 0});
  parts.push_back({sleeve(0.97f * radius, clevis, sleeve_from), kSteel, 0, 0});
  parts.push_back({sleeve(1.06f * radius, sleeve_from, sleeve_from + kBandLength), painted(band), 0, 0});
  parts.push_back({sleeve(radius, sleeve_from + kBandLength, length), kInsulation, 0, 0});
  return parts;
}

std::vector<InstrumentPart> probe(float radius, float length, const Vec3f& band) {
  constexpr float kBandFrom = 0.032f;
  std::vector<InstrumentPart> parts;
  parts.push_back({round_tip(radius, length), kSteel, 0, 0});
  parts.push_back({sleeve(1.06f * radius, kBandFrom, kBandFrom + kBandLength), painted(band), 0, 0});
  InstrumentPart marks{{}, kInsulation, 0, 0};
  for (float z = kMarkSpacing; z + kMarkWidth < length; z += kMarkSpacing) {
    if (std::abs(z - kBandFrom) < 1.5f * kBandLength) continue;
    append(sleeve(1.012f * radius, z, z + kMarkWidth), marks.mesh);
  }
  parts.push_back(std::move(marks));
  return parts;
}

}  // namespace

std::vector<InstrumentPart> instrument_parts(const scene::ToolSpec& tool, const Vec3f& band_colour) {
  const auto radius = static_cast<float>(tool.shaft_radius_m);
  const auto length = static_cast<float>(tool.shaft_length_m);
  return tool.shape == "grasper" ? grasper(radius, length, band_colour) : probe(radius, length, band_colour);
}

Mat4f part_pose(const InstrumentPart& part, const Eigen::Vector3d& p_WT, const Eigen::Quaterniond& q_WT,
                double grip_rad) {
  Eigen::Isometry3d pose = Eigen::Translation3d(p_WT) * q_WT.normalized();
  if (part.jaw != 0) {
    // the jaw hangs along -z from the hinge: a positive turn about y moves it towards -x
    const Eigen::Vector3d hinge(0, 0, part.hinge_z);
    pose = pose * Eigen::Translation3d(hinge) *
           Eigen::AngleAxisd(-0.5 * part.jaw * grip_rad, Eigen::Vector3d::UnitY()) *
           Eigen::Translation3d(-hinge);
  }
  return pose.matrix().cast<float>();
}

Vec3f tool_colour(std::uint32_t id) {
  // distinct from tissue, from each other, and for red-green blindness (blue against yellow)
  static const std::array<Vec3f, 4> colours{
      {{0.03f, 0.52f, 0.85f}, {0.95f, 0.55f, 0.04f}, {0.55f, 0.30f, 0.85f}, {0.25f, 0.75f, 0.30f}}};
  return colours[id % colours.size()];
}

}  // namespace omentum::render
