// The organs of a scene that is being prepared, from the files that the command line names.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace omentum::scene_prepare {

/// Which of the scene's organs have a file: all but tubes, which are made from the scene's numbers.
std::vector<std::size_t> organs_of_files(const scene::Scene& scene);

/// The k-th of `files` becomes the file of the k-th organ that has one; what is left over keeps the file that
/// the scene names. Throws std::runtime_error where there are more files than such organs, or one without.
void name_files(const std::vector<std::string>& files, scene::Scene& scene);

/// The k-th of `files` becomes the file of the scene's k-th scenery; what is left over keeps its own. Throws
/// std::runtime_error where there are more.
void name_scenery(const std::vector<std::string>& files, scene::Scene& scene);

}  // namespace omentum::scene_prepare
