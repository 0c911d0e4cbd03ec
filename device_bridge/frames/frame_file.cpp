#include "device_bridge/frames/frame_file.h"

#include "scene/toml_section.h"

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

using scene::TomlSection;
using enum TomlSection::Need;

// A hand's millimetre is a micrometre of the tool at least, and a centimetre at most: beyond, somebody wrote
// another unit.
constexpr scene::Range kScale{.minimum = 1e-3, .maximum = 10};
// What more than this would make of a force is a knock, not a feeling; limits hold anyway.
constexpr scene::Range kForceScale{.minimum = 0, .maximum = 10, .above = true};
constexpr double kSquare = 1e-3;  // cosine of two axes that are across each other
// Of the shaft: so much stays outside where nothing is said, so that the lever is 2 at most.
constexpr double kUsualOutside = 1.0 / 3;
constexpr std::uint32_t kLastButton = 31;
// Of a base from the scene's origin: farther, somebody wrote millimetres.
constexpr double kFarthest_m = 100;

const scene::ToolSpec& tool_of(TomlSection& s, const std::vector<scene::ToolSpec>& tools) {
  std::uint32_t id = 0;
  s.read("tool", id, kRequired, msg::MAX_TOOLS - 1);
  const auto tool = std::ranges::find_if(tools, [id](const scene::ToolSpec& t) { return t.id == id; });
  if (tool == tools.end()) s.refuse("tool", std::to_string(id), "a tool of the scene");
  return *tool;
}

Vec3 read_origin(TomlSection& s) {
  Vec3 p_WB = Vec3::Zero();
  s.read("origin", p_WB, kOptional);
  if (!(p_WB.norm() <= kFarthest_m))
    s.refuse("origin", std::to_string(p_WB.norm()) + " m from the scene's", "at most 100 m");
  return p_WB;
}

Quat read_axes(TomlSection& s) {
  Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  s.read_direction("x_axis", x, kOptional);
  s.read_direction("z_axis", z, kOptional);
  if (std::abs(x.dot(z)) > kSquare)
    s.refuse("x_axis", "a cosine of " + std::to_string(x.dot(z)) + " with z_axis", "axes across each other");
  Eigen::Matrix3d R_WB;
  R_WB.col(2) = z;
  R_WB.col(1) = z.cross(x).normalized();
  R_WB.col(0) = R_WB.col(1).cross(z);
  return Quat(R_WB);
}

std::optional<TrocarLever> read_lever(TomlSection& s, const scene::ToolSpec& tool) {
  std::string holds = "tip";
  s.read_word("holds", holds, kOptional, {"tip", "handle"});
  if (holds == "tip") return std::nullopt;
  if (!tool.trocar) s.refuse("holds", "\"handle\" of a tool without a trocar", "\"tip\"");
  TrocarLever lever{*tool.trocar, tool.shaft_length_m, kUsualOutside * tool.shaft_length_m};
  s.read("least_outside_m", lever.least_outside_m, kOptional,
         {.minimum = 0, .maximum = tool.shaft_length_m, .above = true, .below = true});
  return lever;
}

// Button 0 cuts.
std::optional<std::uint32_t> read_button(TomlSection& s, const std::string& key) {
  std::uint32_t button = 0;
  s.read(key, button, kOptional, kLastButton);
  if (!s.has(key)) return std::nullopt;
  if (button == 0) s.refuse(key, "0, which cuts", "1 to 31");
  return button;
}

MappingSpec read_device(TomlSection& s, const scene::ToolSpec& tool) {
  MappingSpec spec;
  spec.base.q_WB = read_axes(s);
  spec.base.p_WB = read_origin(s);
  s.read("scale", spec.base.scale, kOptional, kScale);
  s.read("force_scale", spec.force_scale, kOptional, kForceScale);
  spec.lever = read_lever(s, tool);
  spec.clutch_button = read_button(s, "clutch_button");
  spec.enable_button = read_button(s, "enable_button");
  if (spec.clutch_button && spec.clutch_button == spec.enable_button)
    s.refuse("clutch_button", "the enable_button", "another one");
  s.refuse_unknown_keys();
  return spec;
}

}  // namespace

std::map<std::uint32_t, MappingSpec> read_frames(const std::filesystem::path& file,
                                                 const std::vector<scene::ToolSpec>& tools) {
  TomlSection root = scene::open_toml(file);
  std::vector<TomlSection> devices = root.sections("devices");
  root.refuse_unknown_keys();
  std::map<std::uint32_t, MappingSpec> mappings;
  for (TomlSection& s : devices) {
    const scene::ToolSpec& tool = tool_of(s, tools);
    if (!mappings.emplace(tool.id, read_device(s, tool)).second)
      s.refuse("tool", std::to_string(tool.id) + " again", "one of [[devices]] for each tool");
  }
  return mappings;
}

}  // namespace omentum::device
