// Dear ImGui on our contexts.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::gl {

class GlContext;

/// Owns Dear ImGui's context, fonts and drivers while it lives; one at a time.
class PanelBackend {
 public:
  /// `asked_scale`: 0: the monitor's and the picture's (panel_style.h).
  PanelBackend(GlContext& context, float asked_scale);
  ~PanelBackend();
  PanelBackend(const PanelBackend&) = delete;
  PanelBackend& operator=(const PanelBackend&) = delete;

  Input begin_frame();  // events; the panel may be laid out from here on
  void draw();          // into the bound framebuffer
  float scale() const { return scale_; }

 private:
  void fit();  // a window may have come to another monitor, or become larger

  GlContext& context_;
  float asked_scale_, scale_;
};

}  // namespace omentum::render::gl
