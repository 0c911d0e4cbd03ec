// Reads the waypoints of a simulated hand.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// [[hands.way]] of one of [[hands]]; none where it has none.
std::vector<HandWaypoint> read_way(TomlSection& hand);

}  // namespace omentum::scene
