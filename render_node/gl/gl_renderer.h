// Draws with OpenGL 3.3.
#pragma once

#include "render_node/renderer.h"

#include <memory>

namespace omentum::render::gl {

/// A window on the display. Throws DisplayError (gl_context.h) where there is none.
std::unique_ptr<Renderer> open_window(Size size, const std::string& title);
/// Pictures in memory, with the same framebuffers and shaders as the window. Throws DisplayError.
std::unique_ptr<Renderer> open_offscreen(Size size);

}  // namespace omentum::render::gl
