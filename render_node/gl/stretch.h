// A picture of fewer pixels over a whole framebuffer.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/gl/render_target.h"

namespace omentum::render::gl {

/// Owns what that takes.
class Stretch {
 public:
  Stretch();
  ~Stretch();
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

  /// Over the viewport of the bound framebuffer, smoothly. `from` has one sample per pixel.
  void draw(const RenderTarget& from) const;

 private:
  Program program_;
  unsigned no_vertices_ = 0;
};

}  // namespace omentum::render::gl
