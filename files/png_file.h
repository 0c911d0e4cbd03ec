// A picture as a PNG file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace omentum::files {

/// Writes [height][width] pixels of red, green, blue and opacity, the top row first. Whole or not at all
/// (write_whole). Throws std::runtime_error "FILE: cannot write the picture: REASON". Any thread.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace omentum::files
