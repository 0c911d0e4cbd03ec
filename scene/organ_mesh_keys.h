// Which meshes an organ is built of, as a scene names them.
#pragma once

#include "scene/dynamics_spec.h"
#include "scene/toml_section.h"

#include <filesystem>

namespace omentum::scene {

/// A file as a scene names it: beside the scene, unless it is absolute.
std::filesystem::path beside(const std::filesystem::path& scene, const std::filesystem::path& file);

/// The mesh under `key`, which has been read as `written`: a word of what organ_phantom makes, as it stands,
/// or a file's path. Throws for a word that organ_phantom does not know.
std::string mesh_named(TomlSection& s, const char* key, const std::string& written,
                       const std::filesystem::path& scene);

/// `dynamic` or `dynamic_mesh` of a hybrid organ that is built of a mesh: one of the two.
void read_dynamic_part(TomlSection& s, const std::filesystem::path& scene, DynamicsSpec& dynamics);

}  // namespace omentum::scene
