// A scene as a list of values: by it two machines tell whether theirs are alike, and where they are not.
#pragma once

#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace omentum::scene {

/// What every machine of a session must have alike, one value each in the scene's order, defaults included:
/// "organs[0].young_pa = 6000". Numbers are the shortest that are read back the same. Left out is what a
/// machine may have its own way (the scene's name, its camera, paths, an organ's `look`), and what the hash
/// of an organ's file tells in full: its mesh in metres (`mesh`, `metres_per_unit`) and supports from a file.
std::vector<std::string> scene_values(const Scene& scene);

/// The text in one line: control characters as "\x0a".
std::string printable(std::string_view text);

/// SHA-256 of the values, each with a line feed behind it; 64 hexadecimal digits.
std::string scene_hash(const std::vector<std::string>& values);

}  // namespace omentum::scene
