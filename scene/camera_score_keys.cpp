#include "scene/camera_score_keys.h"

#include "messages/common.h"

#include <algorithm>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// Nobody holds a hand stiller than 1 degree; beyond 45 a target is out of any scope's sight.
constexpr Range kWithin_deg{.minimum = 1, .maximum = 45};

void read_target_tool(TomlSection& s, const std::vector<ToolSpec>& tools, CameraScoreSpec& camera) {
  std::uint32_t id = 0;
  s.read("tool", id, kRequired, msg::MAX_TOOLS - 1);
  const auto found = std::ranges::find(tools, id, &ToolSpec::id);
  if (found == tools.end() || found->scope)
    s.refuse("tool", std::to_string(id), "the id of one of the [[tools]] that is no endoscope");
  camera.tool = id;
}

void read_target_place(TomlSection& s, const std::vector<OrganSpec>& organs, CameraScoreSpec& camera) {
  s.read("organ", camera.organ, kRequired);
  s.read("place", camera.place, kRequired);
  if (std::ranges::find(organs, camera.organ, &OrganSpec::name) == organs.end())
    s.refuse("organ", "\"" + camera.organ + "\"", "the name of one of the [[organs]]");
}

}  // namespace

std::optional<CameraScoreSpec> read_camera_score(TomlSection& score, const std::vector<OrganSpec>& organs,
                                                 const std::vector<ToolSpec>& tools) {
  const bool given = score.has("camera");
  TomlSection s = score.section("camera");
  if (!given) return std::nullopt;
  CameraScoreSpec camera;
  if (s.has("tool") == s.has("organ"))
    s.refuse("tool", s.has("tool") ? "a tool and an organ" : "no target", "either tool, or organ and place");
  if (s.has("tool")) {
    read_target_tool(s, tools, camera);
  } else {
    read_target_place(s, organs, camera);
  }
  s.read("within_deg", camera.within_deg, kOptional, kWithin_deg);
  s.refuse_unknown_keys();
  const auto is_scope = [](const ToolSpec& tool) { return tool.scope.has_value(); };
  if (std::ranges::none_of(tools, is_scope))
    score.refuse("camera", "one without a scope", "a tool of shape = \"endoscope\"");
  return camera;
}

}  // namespace omentum::scene
