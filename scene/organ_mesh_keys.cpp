#include "scene/organ_mesh_keys.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// What organ_phantom makes: the liver in two sizes, its gallbladder, the colon, and pieces of tissue.
constexpr std::array<std::string_view, 8> kPhantoms{
    "phantom:paper", "phantom:fine",     "phantom:gallbladder",    "phantom:colon",
    "phantom:plate", "phantom:cylinder", "phantom:cylinder-upper", "phantom:cylinder-lower"};

std::string list_of_phantoms() {
  std::string list;
  for (const std::string_view word : kPhantoms) list.append(list.empty() ? "\"" : ", \"").append(word) += '"';
  return list;
}

}  // namespace

std::filesystem::path beside(const std::filesystem::path& scene, const std::filesystem::path& file) {
  return (scene.parent_path() / file).lexically_normal();
}

std::string mesh_named(TomlSection& s, const char* key, const std::string& written,
                       const std::filesystem::path& scene) {
  if (!written.starts_with("phantom:")) return beside(scene, written).string();
  if (std::ranges::find(kPhantoms, written) == kPhantoms.end())
    s.refuse(key, "\"" + written + "\"", list_of_phantoms() + " or a file");
  return written;
}

void read_dynamic_part(TomlSection& s, const std::filesystem::path& scene, DynamicsSpec& dynamics) {
  if (!s.has("dynamic_mesh")) {
    s.read("dynamic", dynamics.dynamic_part, kRequired);
    return;
  }
  if (s.has("dynamic"))
    s.refuse("dynamic", "one beside dynamic_mesh", "one of the two: that mesh is the dynamic part");
  std::string mesh;
  s.read("dynamic_mesh", mesh, kRequired);
  dynamics.dynamic_mesh = mesh_named(s, "dynamic_mesh", mesh, scene);
}

}  // namespace omentum::scene
