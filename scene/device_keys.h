// Reads which device a tool is for.
#pragma once

#include "scene/scene.h"
#include "scene/toml_section.h"

namespace omentum::scene {

/// `device`: the name that its device gives itself (DeviceInfo.name). Of several that move the tool this one
/// has it; absent, the first one.
void read_device(TomlSection& s, ToolSpec& tool);

}  // namespace omentum::scene
