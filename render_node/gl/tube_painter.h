// Draws a frame's tubes.
#pragma once

#include "render_node/gl/programs.h"
#include "render_node/gl/tube_buffer.h"
#include "render_node/tube_resolution.h"

#include <functional>
#include <optional>

namespace omentum::render::gl {

/// Holds tubes, cylinders of every n that was drawn, and their programs. What fragment shaders share with
/// those of meshes is set by whoever owns this.
class TubePainter {
 public:
  TubePainter();

  TubeId add();
  void update(TubeId tube, std::span<const SkinFrame> frames);

  void cast_shadows(const Frame& frame);
  /// Their triangles alone, in the colour of wires.h.
  void draw_wires(const Frame& frame);
  /// Those that look so. `set_scene`: sets the uniforms of the program in use that tubes share with meshes.
  void draw(const Frame& frame, Look look, const std::function<void(const Program&)>& set_scene);

 private:
  struct Wall {
    explicit Wall(Shading shading);
    Program gut, map;
  };
  void draw(const TubeItem& item, Quality quality);

  std::array<std::optional<Wall>, kShadingCount> walls_;  // made when first needed
  Program shadow_, wires_;
  using Cylinders = std::array<std::optional<CylinderBuffer>, kMostTubeN + 1>;  // by n
  Cylinders cylinders_, few_cylinders_;
  std::vector<TubeBuffer> tubes_;
};

}  // namespace omentum::render::gl
