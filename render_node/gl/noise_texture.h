// The tissue's pattern in the graphics memory.
#pragma once

#include "render_node/tissue_pattern.h"

namespace omentum::render::gl {

/// Repeats in all directions.
class NoiseTexture {
 public:
  explicit NoiseTexture(const TissuePattern& pattern);
  ~NoiseTexture();
  NoiseTexture(const NoiseTexture&) = delete;
  NoiseTexture& operator=(const NoiseTexture&) = delete;
  void bind(int unit) const;

 private:
  unsigned texture_ = 0;
};

}  // namespace omentum::render::gl
