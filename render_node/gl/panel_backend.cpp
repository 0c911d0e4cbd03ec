#include "render_node/gl/panel_backend.h"

#include "render_node/gl/gl_context.h"
#include "render_node/panel_style.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace omentum::render::gl {

PanelBackend::PanelBackend(GlContext& context, float asked_scale)
    : context_(context),
      asked_scale_(asked_scale),
      scale_(ui_scale(asked_scale, context.content_scale(), context.size())) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file where somebody happened to start it
  style_panel(scale_);
  context_.start_panel();
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

PanelBackend::~PanelBackend() {
  ImGui_ImplOpenGL3_Shutdown();
  context_.stop_panel();
  ImGui::DestroyContext();
}

void PanelBackend::fit() {
  const float scale = ui_scale(asked_scale_, context_.content_scale(), context_.size());
  if (scale == scale_) return;
  scale_ = scale;
  style_panel(scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

Input PanelBackend::begin_frame() {
  fit();
  ImGui_ImplOpenGL3_NewFrame();
  const Input input = context_.begin_frame();
  ImGui::NewFrame();
  return input;
}

void PanelBackend::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace omentum::render::gl
