// Reads what a trainee is measured by.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// [score], of a scene with these organs.
ScoreSpec read_score(TomlSection s, const std::vector<OrganSpec>& organs);

}  // namespace omentum::scene
