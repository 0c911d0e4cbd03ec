// The organ of a scene in scenes/, built as the launcher builds it.
#pragma once

#include "tests/support/process.h"

#include <optional>

namespace omentum::test {

/// Whether the organ has the regions that its scene gives it.
enum class Regions { kOfTheScene, kNone };

/// Makes NAME.h5 of scenes/NAME.toml in `folder`, and beside it NAME.toml, the scene fitted to it. Returns
/// the organ file; nothing where organ_phantom is absent. Throws std::runtime_error with a program's words.
std::optional<std::filesystem::path> build_scene_organ(const std::string& name, Regions regions,
                                                       const std::filesystem::path& folder);

}  // namespace omentum::test
