// Reads what an assistant who holds the camera is measured by.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// [score.camera] of [score]; none where it is absent. Needs an endoscope among the tools.
std::optional<CameraScoreSpec> read_camera_score(TomlSection& score, const std::vector<OrganSpec>& organs,
                                                 const std::vector<ToolSpec>& tools);

}  // namespace omentum::scene
