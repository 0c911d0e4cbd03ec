#include "render_node/gl/panel_backend.h"

#include "render_node/gl/gl_context.h"
#include "render_node/panel_style.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace omentum::render::gl {
namespace {

// The mouse moves over the panel, or presses or lets go what lies on it.
bool touched() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.WantCaptureMouse) return false;
  return io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 || ImGui::IsMouseClicked(0) ||
         ImGui::IsMouseReleased(0);
}

bool any(const KeyPresses& keys) {
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (keys.has(letter)) return true;
  return false;
}

}  // namespace

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
  picture_.forget();
}

Input PanelBackend::begin_frame() {
  if (laid_out_) ImGui::EndFrame();
  fit();
  ImGui_ImplOpenGL3_NewFrame();
  const Input input = context_.begin_frame();
  typed_ = any(input.keys);
  ImGui::NewFrame();
  laid_out_ = true;
  return input;
}

void PanelBackend::draw(unsigned to, Size picture) {
  ImGui::Render();
  laid_out_ = false;
  const bool at_once = !context_.has_window() || typed_ || touched();
  picture_.update(*ImGui::GetDrawData(), picture, ImGui::GetTime(), at_once);
  picture_.blend(to);
}

}  // namespace omentum::render::gl
