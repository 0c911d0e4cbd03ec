// The organs of a scene that is being prepared, from the files that the command line names.
#pragma once

#include "organ/organ.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// The k-th of `files` becomes the file of the scene's k-th organ; what is left over keeps the file that the
/// scene names. Throws std::runtime_error where there are more files than organs, or an organ without one.
void name_files(const std::vector<std::string>& files, scene::Scene& scene);

/// All of the scene's organs, without their tensors. Throws geometry::InputError.
std::vector<organ::Organ> load_all(const scene::Scene& scene);

}  // namespace omentum::scene_prepare
