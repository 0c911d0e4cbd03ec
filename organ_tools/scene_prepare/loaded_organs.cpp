#include "organ_tools/scene_prepare/loaded_organs.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::scene_prepare {

void name_files(const std::vector<std::string>& files, scene::Scene& scene) {
  if (files.size() > scene.organs.size()) {
    throw std::runtime_error("--organ: found " + std::to_string(files.size()) + " files, expected at most " +
                             std::to_string(scene.organs.size()) + ", the organs of " + scene.file.string());
  }
  for (std::size_t i = 0; i < files.size(); ++i) scene.organs[i].file = files[i];
  const auto nameless =
      std::ranges::find_if(scene.organs, [](const auto& organ) { return organ.file.empty(); });
  if (nameless == scene.organs.end()) return;
  throw std::runtime_error(scene.file.string() + ": organ \"" + nameless->name +
                           "\" has no file, expected another --organ FILE, in the scene's order");
}

std::vector<organ::Organ> load_all(const scene::Scene& scene) {
  std::vector<organ::Organ> organs;
  for (const scene::OrganSpec& spec : scene.organs)
    organs.push_back(organ::load_organ(spec.file, organ::Load::kMeshOnly));
  return organs;
}

}  // namespace omentum::scene_prepare
