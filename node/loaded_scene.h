// The organs that a node loaded, beside those that a deform_node says it serves.
#pragma once

#include "transport/messages.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::node {

struct LoadedScene {
  std::size_t organ_count = 0;         // of the node's scene
  std::vector<msg::OrganInfo> organs;  // loaded from it, in its order; maybe fewer
};

/// Why this node must not take part in `announced`: another protocol, another number of organs, or other
/// organ files (both hashes are named). Any thread.
std::optional<std::string> contradicts(const LoadedScene& loaded, const msg::SceneInfo& announced);

/// What a node that is settled (rivals.h) makes of such a scene: a fault, and goes on.
inline constexpr const char* kForeignScene =
    "scene: a deform_node with other organs or another protocol appeared, ignored";

}  // namespace omentum::node
