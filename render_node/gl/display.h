// A window where there is a display, memory where there is none.
#pragma once

#include "render_node/renderer.h"
#include "runtime/room.h"

#include <filesystem>
#include <memory>

namespace omentum::render::gl {

inline constexpr Size kWindowSize{1280, 800};
inline constexpr Size kOffscreenSize{960, 600};
/// A node's, and what Mesa takes to draw on the processor: its driver, and a thread for each of up to 16
/// cores. Mesa ends in a signal where it does not get it.
inline constexpr runtime::Room kRoomToDraw{32, std::size_t{1} << 30};

/// `size` 0x0: the default above. Without a display, says so on stdout and writes pictures to `out` instead.
/// `ui_scale`: as open_window() takes it. Throws DisplayError where neither a window nor an off-screen
/// picture can be drawn.
std::unique_ptr<Renderer> open_display(bool headless, Size size, const std::string& title,
                                       const std::filesystem::path& out, float ui_scale = 0);

}  // namespace omentum::render::gl
