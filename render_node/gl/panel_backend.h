// Dear ImGui on our contexts.
#pragma once

#include "render_node/gl/panel_picture.h"
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

  /// Events; the panel may be laid out from here on. What was laid out before and never drawn is dropped.
  Input begin_frame();
  /// Over the framebuffer `to`. Leaves it bound. Off-screen as it was laid out; in a window as it is due
  /// (PanelRefresh).
  void draw(unsigned to, Size picture);
  float scale() const { return scale_; }

 private:
  void fit();  // a window may have come to another monitor, or become larger

  GlContext& context_;
  float asked_scale_, scale_;
  PanelPicture picture_;
  bool typed_ = false;     // a key, since the last frame
  bool laid_out_ = false;  // a frame of Dear ImGui is open
};

}  // namespace omentum::render::gl
