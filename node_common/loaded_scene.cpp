#include "node_common/loaded_scene.h"

#include "scene/scene_values.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace omentum::node {
namespace {

using Values = std::vector<std::string>;

struct Value {
  std::string_view key, text;
};

Value split(std::string_view line) {
  const std::size_t end = line.find(" = ");
  if (end == std::string_view::npos) return {line, {}};
  return {line.substr(0, end), line.substr(end + 3)};
}

bool has(const Values& values, std::string_view key) {
  return std::any_of(values.begin(), values.end(),
                     [key](const std::string& line) { return split(line).key == key; });
}

// in one line, whoever wrote the values
std::string differs(std::string_view key, std::string_view theirs, std::string_view ours) {
  std::string line = "scene: ";
  line.append(key).append(" is ").append(theirs).append(" at deform_node, ").append(ours).append(" here");
  return scene::printable(line);
}

// Where one list has a value more, the other's next one is not what differs.
std::string first_difference(const Values& theirs, const Values& ours) {
  constexpr std::string_view kAbsent = "not given";
  const auto [t, o] = std::mismatch(theirs.begin(), theirs.end(), ours.begin(), ours.end());
  if (t != theirs.end() && !has(ours, split(*t).key)) return differs(split(*t).key, split(*t).text, kAbsent);
  if (o != ours.end() && !has(theirs, split(*o).key)) return differs(split(*o).key, kAbsent, split(*o).text);
  if (t == theirs.end() || o == ours.end() || split(*t).key != split(*o).key)
    return "scene: deform_node is another version of Omentum, whose scene values are listed otherwise";
  return differs(split(*t).key, split(*t).text, split(*o).text);
}

std::string bounded(const std::string& text) {
  return text.substr(0, msg::MAX_NAME);
}

}  // namespace

LoadedScene loaded_scene(const scene::Scene& scene, std::vector<msg::OrganInfo> organs) {
  LoadedScene loaded{scene::scene_values(scene), {}, scene.organs.size(), std::move(organs)};
  loaded.hash = scene::scene_hash(loaded.values);
  return loaded;
}

msg::SceneInfo to_message(const LoadedScene& loaded, const std::string& scene_name) {
  msg::SceneInfo info{.protocol = msg::PROTOCOL_VERSION,
                      .scene = bounded(scene_name),
                      .hash = loaded.hash,
                      .values = loaded.values,
                      .organs = loaded.organs};
  for (msg::OrganInfo& organ : info.organs) {
    organ.name = bounded(organ.name);
    organ.hash = bounded(organ.hash);
  }
  return info;
}

void require_tellable(const scene::Scene& scene) {
  const Values values = scene::scene_values(scene);
  if (values.size() > msg::MAX_SCENE_LINES) {
    throw std::runtime_error(scene.file.string() + ": found " + std::to_string(values.size()) +
                             " values, expected at most " + std::to_string(msg::MAX_SCENE_LINES));
  }
  for (const std::string& line : values) {
    if (line.size() <= msg::MAX_LINE) continue;
    const Value value = split(line);
    const std::size_t most = msg::MAX_LINE - (line.size() - value.text.size());
    throw std::runtime_error(scene.file.string() + ": " + std::string(value.key) + ": found " +
                             std::to_string(value.text.size()) + " characters, expected at most " +
                             std::to_string(most));
  }
}

std::optional<std::string> contradicts(const LoadedScene& loaded, const msg::SceneInfo& announced) {
  if (announced.protocol != msg::PROTOCOL_VERSION) {
    return "deform_node speaks protocol " + std::to_string(announced.protocol) + ", this node speaks " +
           std::to_string(msg::PROTOCOL_VERSION);
  }
  if (announced.hash != loaded.hash) return first_difference(announced.values, loaded.values);
  if (announced.organs.size() != loaded.organ_count) {
    return "deform_node serves " + std::to_string(announced.organs.size()) + " organs of scene " +
           scene::printable(announced.scene) + ", this node's scene has " +
           std::to_string(loaded.organ_count);
  }
  for (std::size_t i = 0; i < loaded.organs.size(); ++i) {
    const std::string& theirs = announced.organs[i].hash;
    if (announced.organs[i].kind != loaded.organs[i].kind)
      return "organ " + loaded.organs[i].name + ": deform_node takes it for an organ of another kind";
    if (theirs == loaded.organs[i].hash) continue;
    return "organ " + loaded.organs[i].name + ": deform_node loaded another organ file, its hash is " +
           scene::printable(theirs) + ", this node's is " + loaded.organs[i].hash;
  }
  return std::nullopt;
}

}  // namespace omentum::node
