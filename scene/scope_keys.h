// Reads what an endoscope is, and that it has nothing to touch with.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// The word of a tool's shape that is looked through.
inline constexpr const char* kScopeShape = "endoscope";

/// What a tool touches with, `points`; of an endoscope its optics instead, and no points, edge or jaws.
void read_points_or_scope(TomlSection& s, ToolSpec& tool);

/// At most one: the picture is one scope's.
void refuse_second_scope(const std::vector<ToolSpec>& tools, const std::vector<TomlSection>& sections);

}  // namespace omentum::scene
