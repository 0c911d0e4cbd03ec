// Dear ImGui without anything to draw on: what laying a panel out needs.
#pragma once

#include "render_node/panel_style.h"

#include <imgui.h>

namespace omentum::render {

/// Makes ImGui's context with the panel's style and fonts; ends it at the end.
class PanelContext {
 public:
  PanelContext() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    style_panel();
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  ~PanelContext() { ImGui::DestroyContext(); }
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
};

}  // namespace omentum::render
