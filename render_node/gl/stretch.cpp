#include "render_node/gl/stretch.h"

#include "shader_sources.h"  // generated from gl/shaders/

#include <epoxy/gl.h>

#include <cmath>

namespace omentum::render::gl {

Stretch::Stretch(bool software)
    : software_(software), program_("stretch", shaders::stretch_vert, "", shaders::stretch_frag) {
  glGenVertexArrays(1, &no_vertices_);
}

Stretch::~Stretch() {
  glDeleteVertexArrays(1, &no_vertices_);
}

void Stretch::draw(const RenderTarget& from, unsigned to, Size target) {
  const float factor = static_cast<float>(target.width) / static_cast<float>(from.size().width);
  const int whole = static_cast<int>(factor);
  // a rest of a pixel or two is held at the edge
  const bool is_whole = std::abs(factor - static_cast<float>(whole)) * static_cast<float>(from.size().width) <
                        static_cast<float>(whole);
  if (software_ && is_whole) return enlarge(from, whole, to, target);
  glBindFramebuffer(GL_FRAMEBUFFER, to);
  glViewport(0, 0, target.width, target.height);
  draw_by_program(from);
}

void Stretch::draw_by_program(const RenderTarget& from) const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, from.texture());
  program_.use();
  program_.set("picture", 0);
  glBindVertexArray(no_vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Read, enlarged, and copied as it is: all three at the speed of memory.
void Stretch::enlarge(const RenderTarget& from, int factor, unsigned to, Size target) {
  const Size size = from.size();
  if (!copy_ || copy_->size() != target) copy_.emplace(target, 0, false);
  small_.resize(4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  large_.resize(4 * static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, small_.data());
  enlarger_.enlarge(small_, size, factor, large_, target);
  glBindTexture(GL_TEXTURE_2D, copy_->texture());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, target.width, target.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                  large_.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, copy_->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, target.width, target.height, 0, 0, target.width, target.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace omentum::render::gl
