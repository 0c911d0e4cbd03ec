// A picture of fewer pixels over a whole framebuffer.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/gl/render_target.h"

namespace omentum::render::gl {

/// Owns what that takes: a program. By two triangles that make a rectangle, which Mesa's rasterizer copies in
/// rows where both pictures have a window's bytes (render_target.h): in a fifth of the time that
/// glBlitFramebuffer takes (docs/rendering.md).
class Stretch {
 public:
  Stretch();
  ~Stretch();
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

  /// Over the whole framebuffer `to`, smoothly. `from` has one sample per pixel.
  void draw(const RenderTarget& from, unsigned to, Size target) const;

 private:
  Program program_;
  unsigned no_vertices_ = 0;
};

}  // namespace omentum::render::gl
