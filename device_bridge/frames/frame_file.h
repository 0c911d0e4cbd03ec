// The file that says how a maker's devices stand in the scene.
#pragma once

#include "device_bridge/frames/hand_mapping.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace omentum::device {

/// Reads the [[devices]] of a file, by tool (docs/devices.md, "Between your device and the scene"). `tools`:
/// the scene's, whose trocars and shafts are the levers. Throws std::runtime_error
/// "FILE:LINE: key: found ..., expected ...".
std::map<std::uint32_t, MappingSpec> read_frames(const std::filesystem::path& file,
                                                 const std::vector<scene::ToolSpec>& tools);

}  // namespace omentum::device
