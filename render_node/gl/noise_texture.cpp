#include "render_node/gl/noise_texture.h"

#include <epoxy/gl.h>

namespace omentum::render::gl {

NoiseTexture::NoiseTexture(const TissuePattern& pattern) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_3D, texture_);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, pattern.side, pattern.side, pattern.side, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, pattern.texels.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

NoiseTexture::~NoiseTexture() {
  glDeleteTextures(1, &texture_);
}

void NoiseTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<unsigned>(unit));
  glBindTexture(GL_TEXTURE_3D, texture_);
}

}  // namespace omentum::render::gl
