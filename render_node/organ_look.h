// What the scene's organs are made of to the eye.
#pragma once

#include "render_node/renderer.h"

#include <string>

namespace omentum::render {

/// The material of a scene's `look` (scene/scene.h): that of the liver for a word that it does not know.
Material tissue_material(const std::string& look);
/// Of blood on it.
Material blood_material();
/// Of what a cut lays bare in it.
Material bared_material(const std::string& look);

}  // namespace omentum::render
