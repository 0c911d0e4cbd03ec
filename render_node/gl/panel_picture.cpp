#include "render_node/gl/panel_picture.h"

#include "shader_sources.h"  // generated from gl/shaders/

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <functional>
#include <string_view>

namespace omentum::render::gl {
namespace {

template <class T>
std::uint64_t bytes_hash(const T* data, int count) {
  return std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(data), sizeof(T) * static_cast<std::size_t>(count)});
}

// Of all triangles: their corners, and which they join. What clips them follows from what is laid out.
std::uint64_t content_of(const ImDrawData& drawn) {
  constexpr std::uint64_t kPrime = 1'099'511'628'211;  // FNV's
  std::uint64_t hash = 0;
  for (int i = 0; i < drawn.CmdListsCount; ++i) {
    const ImDrawList& list = *drawn.CmdLists[i];
    hash = hash * kPrime + bytes_hash(list.VtxBuffer.Data, list.VtxBuffer.Size);
    hash = hash * kPrime + bytes_hash(list.IdxBuffer.Data, list.IdxBuffer.Size);
  }
  return hash;
}

}  // namespace

PanelPicture::PanelPicture() : program_("panel", shaders::panel_vert, "", shaders::stretch_frag) {
  glGenVertexArrays(1, &no_vertices_);
}

PanelPicture::~PanelPicture() {
  glDeleteVertexArrays(1, &no_vertices_);
}

void PanelPicture::update(const ImDrawData& drawn, Size picture, double now_s, bool acted) {
  if (!target_ || target_->size() != picture) {
    target_.emplace(picture, 0, false);
    forget();
  }
  if (!refresh_.due(content_of(drawn), now_s, acted)) return;
  boxes_ = boxes_of(drawn);
  glBindFramebuffer(GL_FRAMEBUFFER, target_->framebuffer());
  glViewport(0, 0, picture.width, picture.height);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  // over nothing its blending leaves colours that are multiplied by their opacity, and the opacity
  ImGui_ImplOpenGL3_RenderDrawData(const_cast<ImDrawData*>(&drawn));
}

void PanelPicture::blend(unsigned to) const {
  const Size size = target_->size();
  glBindFramebuffer(GL_FRAMEBUFFER, to);
  glViewport(0, 0, size.width, size.height);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, target_->texture());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  program_.set("picture", 0);
  glBindVertexArray(no_vertices_);
  const auto x = [&](int pixel) { return static_cast<float>(pixel) / static_cast<float>(size.width); };
  const auto y = [&](int row) { return 1 - static_cast<float>(row) / static_cast<float>(size.height); };
  for (const PixelBox& box : boxes_) {
    program_.set("low", x(box.x0), y(box.y1));
    program_.set("high", x(box.x1), y(box.y0));
    glDrawArrays(GL_TRIANGLES, 0, 6);
  }
  glDisable(GL_BLEND);
}

}  // namespace omentum::render::gl
