// The panel as a picture of its own, which outlasts frames.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/gl/render_target.h"
#include "render_node/panel_boxes.h"
#include "render_node/panel_refresh.h"

#include <optional>

namespace omentum::render::gl {

/// Owns a texture of the picture's size. Dear ImGui draws into it when it is due (PanelRefresh); each frame
/// blends only the boxes that the panel lies on, as rectangles of two triangles: Mesa's rasterizer blends
/// those in rows (stretch.h).
class PanelPicture {
 public:
  PanelPicture();
  ~PanelPicture();
  PanelPicture(const PanelPicture&) = delete;
  PanelPicture& operator=(const PanelPicture&) = delete;

  /// Takes what Dear ImGui rendered, if it is due. `acted`: a person did something.
  void update(const ImDrawData& drawn, Size picture, double now_s, bool acted);
  /// Over the framebuffer `to`, of the size of the last update().
  void blend(unsigned to) const;
  /// What is drawn would look otherwise now (fonts).
  void forget() { refresh_.forget(); }

 private:
  Program program_;
  PanelRefresh refresh_;
  std::optional<RenderTarget> target_;
  std::vector<PixelBox> boxes_;
  unsigned no_vertices_ = 0;
};

}  // namespace omentum::render::gl
