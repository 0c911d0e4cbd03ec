// The panel, laid out with Dear ImGui.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

// Dear ImGui's name of the button whose label is the map that is on.
inline constexpr const char* kMapButton = "###map";
inline constexpr float kPanelWidth = 306;  // pixels
inline constexpr float kPanelMargin = 10;  // pixels, to the picture's edge

/// The share of the picture's width that the panel takes from the scene, on the left; bounded, so that the
/// organ stays in a narrow picture.
double panel_share(Size picture);

/// Lays the panel out in the current Dear ImGui frame and tells what was pressed. Without somebody to press
/// buttons (`interactive` false) it has none. The drawing thread.
PanelActions lay_out_panel(const PanelView& view);

}  // namespace omentum::render
