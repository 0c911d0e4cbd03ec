// Reads what a scene says of an intestine, and of what it lies on and in.
#pragma once

#include "scene/intestine_spec.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// The keys beside `model` of one of [[organs]]; without obstacles.
IntestineSpec read_intestine(TomlSection& organ);

/// One of [[obstacles]].
ObstacleSpec read_obstacle(TomlSection& section);

/// In one scene: every mass of an intestine is held against each of them in every step.
inline constexpr std::size_t kMostObstacles = 16;

/// `count` [[obstacles]] of the file `root`, where `met` says whether an organ meets any. Throws as
/// TomlSection does where there are too many, or some that nothing meets.
void refuse_wrong_obstacles(const TomlSection& root, std::size_t count, bool met);

}  // namespace omentum::scene
