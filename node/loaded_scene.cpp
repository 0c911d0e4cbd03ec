#include "node/loaded_scene.h"

namespace omentum::node {

std::optional<std::string> contradicts(const LoadedScene& loaded, const msg::SceneInfo& announced) {
  if (announced.protocol != msg::PROTOCOL_VERSION) {
    return "deform_node speaks protocol " + std::to_string(announced.protocol) + ", this node speaks " +
           std::to_string(msg::PROTOCOL_VERSION);
  }
  if (announced.organs.size() != loaded.organ_count) {
    return "deform_node serves " + std::to_string(announced.organs.size()) + " organs of scene " +
           announced.scene + ", this node's scene has " + std::to_string(loaded.organ_count);
  }
  for (std::size_t i = 0; i < loaded.organs.size(); ++i) {
    const std::string& theirs = announced.organs[i].hash;
    if (theirs == loaded.organs[i].hash) continue;
    return "organ " + loaded.organs[i].name + ": deform_node loaded another organ file, its hash is " +
           theirs + ", this node's is " + loaded.organs[i].hash;
  }
  return std::nullopt;
}

}  // namespace omentum::node
