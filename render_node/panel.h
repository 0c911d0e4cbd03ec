// The panel, laid out with Dear ImGui: figures on the left, controls at the lower edge, help in the middle.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

// At scale 1 (panel_style.h), pixels.
inline constexpr float kPanelWidth = 306;
inline constexpr float kPanelMargin = 10;  // to the picture's edge

/// The share of the picture's width that the panel takes from the scene, on the left; bounded, so that the
/// organ stays in a narrow picture.
double panel_share(Size picture, float ui_scale = 1);

/// Lays the panel out in the current Dear ImGui frame and tells what was pressed. Without somebody to press
/// buttons (`interactive` false) it has none. The drawing thread.
PanelActions lay_out_panel(const PanelView& view);

}  // namespace omentum::render
