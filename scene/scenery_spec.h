// What is seen around the organs, and nothing else: it is neither touched nor moved.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace omentum::scene {

/// One piece of scenery. Machines of a session may have their own: no force depends on it.
struct ScenerySpec {
  std::string mesh;            // a mesh file (relative to the scene), or "phantom:..." (scenery_keys.cpp)
  double metres_per_unit = 1;  // of the mesh
  std::string look = "wall";   // one of kSceneryLooks
  std::filesystem::path file;  // the mesh file; the launcher fills it in where `mesh` is a word
};

/// "wall" is seen from inside alone: who looks from outside looks through its near side.
inline constexpr std::array<std::string_view, 5> kSceneryLooks{"wall", "omentum", "liver", "gallbladder",
                                                               "colon"};

}  // namespace omentum::scene
