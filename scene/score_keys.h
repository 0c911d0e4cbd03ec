// Reads what a trainee is measured by.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// [score], of a scene with these organs and tools.
ScoreSpec read_score(TomlSection s, const std::vector<OrganSpec>& organs, const std::vector<ToolSpec>& tools);

}  // namespace omentum::scene
