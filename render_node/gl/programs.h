// The programs of one way to compute light, by what they draw.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/picture_quality.h"

namespace omentum::render::gl {

/// Of a surface that vertex shader `vertex` places. `defines`: what it is, to `fragment`; `is`: to the light
/// at a vertex (shaders/vertex_light.glsl). Throws as Program does.
Program surface_program(Shading shading, const char* name, std::string_view vertex,
                        const std::string& defines, std::string_view fragment, const std::string& is);

/// Owns them. Throws as Program does.
class Programs {
 public:
  explicit Programs(Shading shading);

  const Program& of(Look look) const;
  const Program& backdrop() const { return backdrop_; }
  const Program& lens() const { return lens_; }

 private:
  Program backdrop_, lens_, tissue_, cut_, bared_, map_, gut_, blood_, smoke_, mesentery_, wall_, solid_,
      ground_, signal_;
};

}  // namespace omentum::render::gl
