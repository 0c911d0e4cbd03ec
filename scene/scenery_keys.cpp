#include "scene/scenery_keys.h"

#include <algorithm>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// What organ_phantom makes, but for pieces of tissue.
constexpr std::array<std::string_view, 5> kSceneryPhantoms{
    "phantom:cavity", "phantom:omentum", "phantom:gallbladder", "phantom:colon", "phantom:paper"};

std::string phantom_words() {
  std::string text;
  for (const std::string_view word : kSceneryPhantoms) text.append("\"").append(word).append("\", ");
  return text + "or a mesh file";
}

std::filesystem::path beside_scene(const std::filesystem::path& scene, const std::string& file) {
  return (scene.parent_path() / file).lexically_normal();
}

void read_piece_mesh(TomlSection& s, const std::filesystem::path& scene, ScenerySpec& piece) {
  s.read("mesh", piece.mesh, kRequired);
  s.read("metres_per_unit", piece.metres_per_unit, kOptional, kPositive);
  std::string file;
  s.read("file", file, kOptional);
  if (!piece.mesh.starts_with("phantom:")) {
    piece.mesh = beside_scene(scene, piece.mesh).string();
    piece.file = piece.mesh;
  } else if (std::ranges::find(kSceneryPhantoms, piece.mesh) == kSceneryPhantoms.end()) {
    s.refuse("mesh", "\"" + piece.mesh + "\"", phantom_words());
  } else if (s.has("metres_per_unit")) {
    s.refuse("metres_per_unit", "one beside \"" + piece.mesh + "\"", "none: the phantom is in metres");
  } else if (!file.empty()) {
    piece.file = beside_scene(scene, file);
  }
}

}  // namespace

std::vector<ScenerySpec> read_scenery(std::vector<TomlSection> sections, const std::filesystem::path& scene) {
  const std::vector<std::string> looks(kSceneryLooks.begin(), kSceneryLooks.end());
  std::vector<ScenerySpec> scenery;
  for (TomlSection& s : sections) {
    if (scenery.size() == kMostScenery)
      s.refuse("mesh", "one more of [[scenery]]", "at most " + std::to_string(kMostScenery));
    ScenerySpec& piece = scenery.emplace_back();
    read_piece_mesh(s, scene, piece);
    s.read_word("look", piece.look, kOptional, looks);
    s.refuse_unknown_keys();
  }
  return scenery;
}

}  // namespace omentum::scene
