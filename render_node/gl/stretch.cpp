#include "render_node/gl/stretch.h"

#include "shader_sources.h"  // generated from gl/shaders/

#include <epoxy/gl.h>

namespace omentum::render::gl {

Stretch::Stretch() : program_("stretch", shaders::stretch_vert, "", shaders::stretch_frag) {
  glGenVertexArrays(1, &no_vertices_);
}

Stretch::~Stretch() {
  glDeleteVertexArrays(1, &no_vertices_);
}

void Stretch::draw(const RenderTarget& from, unsigned to, Size target) const {
  glBindFramebuffer(GL_FRAMEBUFFER, to);
  glViewport(0, 0, target.width, target.height);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, from.texture());
  program_.use();
  program_.set("picture", 0);
  glBindVertexArray(no_vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 6);
}

}  // namespace omentum::render::gl
