// Whether a scene's instruments are of a size with its organ.
#pragma once

#include "organ/organ.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// How wide a tool's tip is: the largest distance between its points, or its shaft's diameter, m.
double tip_size(const scene::ToolSpec& tool);

/// A sentence for each tool whose tip is wider than the organ is long.
std::vector<std::string> smaller_than_tips(const organ::Organ& organ, const scene::Scene& scene);

}  // namespace omentum::scene_prepare
