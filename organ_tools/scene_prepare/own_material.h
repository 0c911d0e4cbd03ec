// Whether a scene says of a built organ what that was built of.
#pragma once

#include "organ/organ.h"
#include "scene/scene.h"

namespace omentum::scene_prepare {

/// Of the scene's k-th organ, which is `organ`: where its mesh is an organ file, whose tensors hold for the
/// material that it was built of, the scene must say the same or nothing, and says it afterwards. Throws
/// std::runtime_error "FILE:LINE: KEY: found ..., expected ...".
void take_own_material(const organ::Organ& organ, std::size_t k, scene::Scene& scene);

}  // namespace omentum::scene_prepare
