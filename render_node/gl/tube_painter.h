// Draws a frame's tubes.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/gl/tube_buffer.h"
#include "render_node/tube_resolution.h"

#include <functional>
#include <optional>

namespace omentum::render::gl {

/// Holds tubes, cylinders of every n that was drawn, and their programs. What fragment shaders share with
/// those of meshes is set by whoever owns this.
class TubePainter {
 public:
  /// What goes before the fragment shaders of fine frames, and of others.
  TubePainter(const std::string& fine, const std::string& plain);

  TubeId add();
  void update(TubeId tube, std::span<const SkinFrame> frames);

  void cast_shadows(const Frame& frame);
  /// Those that look so. `set_scene`: sets the uniforms of the program in use that tubes share with meshes.
  void draw(const Frame& frame, Look look, const std::function<void(const Program&)>& set_scene);

 private:
  struct Programs {
    explicit Programs(const std::string& prefix);
    Program gut, map;
  };
  void draw(const TubeItem& item);

  Programs fine_, plain_;
  Program shadow_;
  std::array<std::optional<CylinderBuffer>, kMostTubeN + 1> cylinders_;  // by n
  std::vector<TubeBuffer> tubes_;
};

}  // namespace omentum::render::gl
