// Mouse and keys of a GLFW window, for whoever moves an instrument with them.
#pragma once

#include "render_node/pointer.h"

struct GLFWwindow;

namespace omentum::render::gl {

/// Once a frame, after the window's events were polled.
class PointerReader {
 public:
  /// `scrolled`: steps of the wheel since the last frame; `taken`: the panel has the pointer.
  Pointer read(GLFWwindow* window, float scrolled, bool taken);

 private:
  double x_ = 0, y_ = 0;
  bool next_key_ = false;  // was down
};

}  // namespace omentum::render::gl
