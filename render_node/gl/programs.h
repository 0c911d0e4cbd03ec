// The programs of one way to compute light, by what they draw.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/picture_quality.h"

namespace omentum::render::gl {

/// Owns them. Throws as Program does.
class Programs {
 public:
  explicit Programs(Shading shading);

  const Program& of(Look look) const;
  const Program& backdrop() const { return backdrop_; }
  const Program& lens() const { return lens_; }

 private:
  Program backdrop_, lens_, tissue_, cut_, bared_, map_, gut_, blood_, smoke_, mesentery_, solid_, ground_, signal_;
};

}  // namespace omentum::render::gl
