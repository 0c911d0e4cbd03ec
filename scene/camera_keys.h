// Reads how a scene is looked at.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// [camera]; `given`: whether the scene has one.
CameraSpec read_camera(TomlSection s, bool given);

}  // namespace omentum::scene
