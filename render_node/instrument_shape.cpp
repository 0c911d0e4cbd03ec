#include "render_node/instrument_shape.h"

#include "render_node/few_triangles.h"
#include "render_node/hook_shape.h"
#include "render_node/jaw_shape.h"
#include "render_node/scope_shape.h"
#include "render_node/shape_pieces.h"

#include <array>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr auto kHinge = static_cast<float>(scene::kJawLength_m);
constexpr float kBandLength = 0.005f;     // m
constexpr float kMarkSpacing = 0.01f;     // m: the probe is a ruler too
constexpr float kMarkWidth = 0.0007f;     // m
constexpr float kFewMarkWidth = 0.0018f;  // m: a pixel of the coarsest pictures, where all of a probe is seen
constexpr float kFewSide = 0.5f;          // of the shaft's radius: what the coarsest pictures show of a part
const Vec3f kWireGlow(6.0f, 1.5f, 0.22f);  // of tungsten at about 2,000 K, far above what the lamps give
const Vec3f kFibreGlow(9.0f, 8.8f, 8.4f);

// Collar, band of the tool's colour, and insulated shaft, from `from` on.
void add_shaft(float radius, float from, float length, const Vec3f& band,
               std::vector<InstrumentPart>& parts) {
  constexpr float kCollar = 0.004f;
  const float band_from = from + kCollar, shaft_from = band_from + kBandLength;
  parts.push_back({sleeve(1.02f * radius, from, band_from), kSteel});
  parts.push_back({ring(1.08f * radius, band_from, shaft_from), painted(band)});
  if (length > shaft_from) parts.push_back({sleeve(radius, shaft_from, length), kInsulation});
}

std::vector<InstrumentPart> grasper(const scene::ToolSpec& tool, const Vec3f& band) {
  const JawForm form = jaw_form(tool);
  const auto radius = static_cast<float>(tool.shaft_radius_m);
  std::vector<InstrumentPart> parts;
  for (const float side : {1.0f, -1.0f}) parts.push_back({jaw_mesh(form, side), kSteel, side, kHinge});
  MeshData holder = cheeks_mesh(radius);
  append(sleeve(0.95f * radius, kHinge + 0.0035f, kHinge + 0.009f), holder);
  parts.push_back({std::move(holder), kDarkSteel});
  parts.push_back({pin_mesh(radius), kSteel});
  add_shaft(radius, kHinge + 0.009f, static_cast<float>(tool.shaft_length_m), band, parts);
  return parts;
}

std::vector<InstrumentPart> probe(const scene::ToolSpec& tool, const Vec3f& band) {
  constexpr float kBandFrom = 0.032f;
  const auto radius = static_cast<float>(tool.shaft_radius_m);
  const auto length = static_cast<float>(tool.shaft_length_m);
  std::vector<InstrumentPart> parts;
  parts.push_back({round_tip(radius, length), kSteel});
  parts.push_back({ring(1.06f * radius, kBandFrom, kBandFrom + kBandLength), painted(band)});
  InstrumentPart marks{{}, kInsulation};
  for (float z = kMarkSpacing; z + kFewMarkWidth < length; z += kMarkSpacing) {
    if (std::abs(z - kBandFrom) < 1.5f * kBandLength) continue;
    append(ring(1.012f * radius, z, z + kMarkWidth, kFewMarkWidth), marks.mesh);
  }
  parts.push_back(std::move(marks));
  return parts;
}

std::vector<InstrumentPart> hook(const scene::ToolSpec& tool, const Vec3f& band) {
  const float ball = jaw_form(tool).radius;  // its points lie on a round tip as closed jaws' do
  const float ceramic = ceramic_from(tool, ball), shaft = ceramic + 0.007f;
  const auto radius = static_cast<float>(tool.shaft_radius_m);
  std::vector<InstrumentPart> parts;
  parts.push_back({ball_mesh(ball, ceramic + 0.001f), kDarkSteel});
  parts.push_back({wire_mesh(tool), kSteel, 0, 0, kWireGlow});
  parts.push_back({sleeve(0.72f * radius, ceramic, shaft), kCeramic});
  add_shaft(radius, shaft, static_cast<float>(tool.shaft_length_m), band, parts);
  return parts;
}

std::vector<InstrumentPart> scope(const scene::ToolSpec& tool, const Vec3f& band) {
  constexpr float kBandFrom = 0.04f;
  const auto radius = static_cast<float>(tool.shaft_radius_m);
  const auto optics = static_cast<float>(tool.scope->optics_deg * std::numbers::pi / 180);
  std::vector<InstrumentPart> parts;
  parts.push_back({scope_tube_mesh(radius, static_cast<float>(tool.shaft_length_m), optics), kSteel});
  parts.push_back({scope_lens_mesh(radius, optics), kGlass});
  Material fibres = kCeramic;
  fibres.glow = kFibreGlow;
  parts.push_back({scope_fibres_mesh(radius, optics), fibres});
  parts.push_back({ring(1.04f * radius, kBandFrom, kBandFrom + kBandLength), painted(band)});
  return parts;
}

std::vector<InstrumentPart> fine_parts(const scene::ToolSpec& tool, const Vec3f& band_colour) {
  if (tool.scope) return scope(tool, band_colour);
  if (tool.shape == "grasper") return grasper(tool, band_colour);
  return tool.edge.empty() ? probe(tool, band_colour) : hook(tool, band_colour);
}

}  // namespace

std::vector<InstrumentPart> instrument_parts(const scene::ToolSpec& tool, const Vec3f& band_colour) {
  std::vector<InstrumentPart> parts = fine_parts(tool, band_colour);
  const float side_m = kFewSide * static_cast<float>(tool.shaft_radius_m);
  for (InstrumentPart& part : parts)
    if (part.mesh.few.empty()) add_few_triangles(part.mesh, side_m);
  return parts;
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
