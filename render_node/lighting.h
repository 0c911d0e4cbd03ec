// The lights: an assistant's lamp over the camera's left shoulder, and the camera's own.
#pragma once

#include "render_node/camera.h"

namespace omentum::render {

/// The key light follows the camera, as an endoscope's does, but from the upper left, so that instruments
/// throw shadows that show their height. Its shadow box holds `ball` exactly.
Lighting light_scene(const Camera& camera, const Ball& ball);

/// For a close-up: the key light rakes over the surface from the left, so that one wall of a dent lies in its
/// own shade and the other one shines.
Lighting rake_light(const Camera& camera, const Ball& ball);

}  // namespace omentum::render
