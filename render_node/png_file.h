// A picture on disk.
#pragma once

#include "render_node/renderer.h"

#include <filesystem>

namespace omentum::render {

/// Writes next to `file` and renames, so that a half-written picture never looks finished. Throws
/// std::runtime_error "FILE: cannot write the picture: REASON". Any thread.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Throws std::runtime_error "FILE: not a readable PNG picture: REASON".
Picture read_png(const std::filesystem::path& file);

}  // namespace omentum::render
