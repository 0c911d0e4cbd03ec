// Where OpenGL draws to: a window (GLFW) or nothing but memory (EGL).
#pragma once

#include "render_node/renderer.h"
#include "runtime/command_line.h"

#include <memory>
#include <string>

namespace omentum::render::gl {

/// No display, no driver, or one without OpenGL 3.3 core: the message says which.
class DisplayError : public runtime::MachineLacks {
 public:
  using MachineLacks::MachineLacks;
};

/// A current OpenGL 3.3 core context. One thread, the one that made it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// Of the picture, pixels; a window's may change between frames.
  virtual Size size() const = 0;
  virtual bool has_window() const = 0;
  /// The monitor's: pixels for what is one elsewhere.
  virtual float content_scale() const { return 1; }
  virtual void start_panel() = 0;  // Dear ImGui's platform part; its context exists
  virtual void stop_panel() = 0;
  virtual Input begin_frame() = 0;
  virtual Pointer look_at_pointer() { return {}; }
  virtual void end_frame() = 0;
};

/// Throws DisplayError.
std::unique_ptr<GlContext> open_egl_context(Size size);
std::unique_ptr<GlContext> open_glfw_context(Size size, const std::string& title);

}  // namespace omentum::render::gl
