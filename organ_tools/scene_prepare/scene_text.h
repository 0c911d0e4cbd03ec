// A scene as text: TOML for the nodes, JSON for the launcher.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace omentum::scene_prepare {

/// The scene file with what fitting changed: organ files and their materials, hands, trocars, camera. All
/// else is carried over. load_scene reads it from any folder.
std::string resolved_toml(const scene::Scene& scene);

/// {"name", "organs": [{"name", "has_file" (false: made from the scene's numbers), "mesh", "metres_per_unit",
/// "young_pa", "poisson", "density_kg_m3", "regions": [as organ_build --region takes them], "fixed"}]}.
nlohmann::json describe(const scene::Scene& scene);

}  // namespace omentum::scene_prepare
