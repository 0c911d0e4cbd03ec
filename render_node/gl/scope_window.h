// Where an endoscope's round field of view is in a picture.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::gl {

/// While it lives nothing but the columns of the field of view (shaders/lens.frag) is drawn into the
/// framebuffer that is bound, of that size, and all beside it is black, as the lens makes it anyway: a third
/// of a picture's pixels costs nothing. Does nothing for a frame that is not seen through an endoscope.
class ScopeWindow {
 public:
  ScopeWindow(const Frame& frame, Size picture);
  ~ScopeWindow();
  ScopeWindow(const ScopeWindow&) = delete;
  ScopeWindow& operator=(const ScopeWindow&) = delete;

 private:
  bool on_;
};

}  // namespace omentum::render::gl
