#include "scene/scope_keys.h"

#include <algorithm>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// Laparoscopes are made with 0, 30 and 45 degrees, cystoscopes with up to 70.
constexpr Range kOptics_deg{.minimum = 0, .maximum = 70};
constexpr Range kScopeField_deg{.minimum = 20, .maximum = 110};

}  // namespace

void read_points_or_scope(TomlSection& s, ToolSpec& tool) {
  if (tool.shape != kScopeShape) {
    s.read("points", tool.points, kRequired);
    return;
  }
  for (const char* key : {"points", "cuts", "edge"})
    if (s.has(key)) s.refuse(key, "one of an endoscope", "none: it touches nothing");
  tool.scope.emplace();
  s.read("optics_deg", tool.scope->optics_deg, kOptional, kOptics_deg);
  s.read("field_of_view_deg", tool.scope->field_of_view_deg, kOptional, kScopeField_deg);
}

void refuse_second_scope(const std::vector<ToolSpec>& tools, const std::vector<TomlSection>& sections) {
  bool found = false;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (!tools[i].scope) continue;
    if (found) sections[i].refuse("shape", "a second endoscope", "one at most: it makes the picture");
    found = true;
  }
}

}  // namespace omentum::scene
