#include "organ_tools/scene_prepare/loaded_organs.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::scene_prepare {

std::vector<std::size_t> organs_of_files(const scene::Scene& scene) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < scene.organs.size(); ++i)
    if (scene.organs[i].kind == scene::OrganKind::kTetrahedralMesh) places.push_back(i);
  return places;
}

void name_files(const std::vector<std::string>& files, scene::Scene& scene) {
  const std::vector<std::size_t> places = organs_of_files(scene);
  if (files.size() > places.size()) {
    throw std::runtime_error("--organ: found " + std::to_string(files.size()) + " files, expected at most " +
                             std::to_string(places.size()) + ", the organs of " + scene.file.string() +
                             " that have one");
  }
  for (std::size_t k = 0; k < files.size(); ++k) scene.organs[places[k]].file = files[k];
  const auto nameless =
      std::ranges::find_if(places, [&](std::size_t i) { return scene.organs[i].file.empty(); });
  if (nameless == places.end()) return;
  throw std::runtime_error(scene.file.string() + ": organ \"" + scene.organs[*nameless].name +
                           "\" has no file, expected another --organ FILE, in the scene's order");
}

void name_scenery(const std::vector<std::string>& files, scene::Scene& scene) {
  if (files.size() > scene.scenery.size()) {
    throw std::runtime_error("--scenery: found " + std::to_string(files.size()) +
                             " files, expected at most " + std::to_string(scene.scenery.size()) +
                             ", the [[scenery]] of " + scene.file.string());
  }
  for (std::size_t k = 0; k < files.size(); ++k) scene.scenery[k].file = files[k];
}

}  // namespace omentum::scene_prepare
