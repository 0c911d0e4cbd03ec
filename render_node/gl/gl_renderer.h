// Draws with OpenGL 3.3.
#pragma once

#include "render_node/renderer.h"

#include <memory>

namespace omentum::render::gl {

/// `ui_scale`: of the panel; 0: as the monitor and the picture's size ask for (panel_style.h).
/// A window on the display. Throws DisplayError (gl_context.h) where there is none.
std::unique_ptr<Renderer> open_window(Size size, const std::string& title, float ui_scale = 0);
/// Pictures in memory, with the same framebuffers and shaders as the window. Throws DisplayError.
std::unique_ptr<Renderer> open_offscreen(Size size, float ui_scale = 0);

}  // namespace omentum::render::gl
