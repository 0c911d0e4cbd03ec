// The scene and organs that a node loaded, beside those that a deform_node says it serves.
#pragma once

#include "scene/scene.h"
#include "transport/messages.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::node {

struct LoadedScene {
  std::vector<std::string> values;     // scene::scene_values
  std::string hash;                    // of them
  std::size_t organ_count = 0;         // of the node's scene
  std::vector<msg::OrganInfo> organs;  // loaded from it, in its order; maybe fewer
};

/// `organs` are those that the node loaded of `scene`.
LoadedScene loaded_scene(const scene::Scene& scene, std::vector<msg::OrganInfo> organs);

/// What a node that serves all organs of the scene tells of it. Longer names are cut.
msg::SceneInfo to_message(const LoadedScene& loaded, const std::string& scene_name);

/// Throws std::runtime_error "FILE: KEY: found ..., expected ..." for a scene whose values SceneInfo cannot
/// tell: too many of them, or one that is too long.
void require_tellable(const scene::Scene& scene);

/// Why this node must not take part in `announced`, in one line: another protocol, another scene (the first
/// value that differs is named), another number of organs, or other organ files (both hashes are named). Any
/// thread.
std::optional<std::string> contradicts(const LoadedScene& loaded, const msg::SceneInfo& announced);

/// What a node that is settled (rivals.h) makes of such a scene: a fault, and goes on.
inline constexpr const char* kForeignScene =
    "scene: a deform_node with other organs, values or another protocol appeared, ignored";

}  // namespace omentum::node
