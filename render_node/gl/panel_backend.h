// Dear ImGui on our contexts.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::gl {

class GlContext;

/// Owns Dear ImGui's context, fonts and drivers while it lives; one at a time.
class PanelBackend {
 public:
  explicit PanelBackend(GlContext& context);
  ~PanelBackend();
  PanelBackend(const PanelBackend&) = delete;
  PanelBackend& operator=(const PanelBackend&) = delete;

  Input begin_frame();  // events; the panel may be laid out from here on
  void draw();          // into the bound framebuffer

 private:
  GlContext& context_;
};

}  // namespace omentum::render::gl
