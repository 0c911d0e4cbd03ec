// A picture of fewer pixels over a whole framebuffer.
#pragma once

#include "render_node/enlarge.h"
#include "render_node/gl/program.h"
#include "render_node/gl/render_target.h"

#include <optional>

namespace omentum::render::gl {

/// Owns what that takes. `software`: OpenGL is a program, and our own enlarging takes half of its time.
class Stretch {
 public:
  explicit Stretch(bool software);
  ~Stretch();
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

  /// Over the whole framebuffer `to`, smoothly. `from` has one sample per pixel.
  void draw(const RenderTarget& from, unsigned to, Size target);

 private:
  void draw_by_program(const RenderTarget& from) const;
  void enlarge(const RenderTarget& from, int factor, unsigned to, Size target);

  bool software_;
  Program program_;
  Enlarger enlarger_;
  std::vector<std::uint8_t> small_, large_;
  std::optional<RenderTarget> copy_;  // of large_
  unsigned no_vertices_ = 0;
};

}  // namespace omentum::render::gl
