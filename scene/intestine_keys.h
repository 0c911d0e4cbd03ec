// Reads what a scene says of an intestine, and of what it lies on and in.
#pragma once

#include "scene/intestine_spec.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// The keys beside `model` of one of [[organs]]; without obstacles.
IntestineSpec read_intestine(TomlSection& organ);

/// One of [[obstacles]].
ObstacleSpec read_obstacle(TomlSection& section);

}  // namespace omentum::scene
