// Reads what is seen around the organs.
#pragma once

#include "scene/scenery_spec.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// The [[scenery]] of the scene in `scene`, at most kMostScenery of them.
std::vector<ScenerySpec> read_scenery(std::vector<TomlSection> sections, const std::filesystem::path& scene);

inline constexpr std::size_t kMostScenery = 16;

}  // namespace omentum::scene
