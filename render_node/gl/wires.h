// The edges of the organs' triangles, drawn over them.
#pragma once

#include "render_node/gl/mesh_buffer.h"
#include "render_node/gl/program.h"
#include "render_node/renderer.h"

#include <functional>

namespace omentum::render::gl {

class Wires {
 public:
  Wires();
  /// Into the framebuffer that has the frame's surfaces and their depths: what those hide has no lines.
  /// `tubes`: draws those of the frame's tubes.
  void draw(const Frame& frame, const std::function<const MeshBuffer&(MeshId)>& mesh,
            const std::function<void()>& tubes) const;

 private:
  Program program_;
};

}  // namespace omentum::render::gl
