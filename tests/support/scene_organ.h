// The organs of a scene in scenes/, built as the launcher builds them.
#pragma once

#include "tests/support/process.h"

#include <optional>

namespace omentum::test {

/// Whether the organ has the regions that its scene gives it.
enum class Regions { kOfTheScene, kNone };

/// Makes the organ files of scenes/NAME.toml in `folder`, and NAME.toml, the scene fitted to them. Returns
/// the first one's file; nothing where organ_phantom is absent. Throws std::runtime_error with a program's
/// words.
std::optional<std::filesystem::path> build_scene_organs(const std::string& name, Regions regions,
                                                        const std::filesystem::path& folder);

}  // namespace omentum::test
