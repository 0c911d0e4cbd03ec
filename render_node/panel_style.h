// The panel's font, colours and size.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

inline constexpr float kPanelFontPixels = 15;  // at scale 1

/// Sets font, spacing and colours of the current Dear ImGui context: calm, dark, translucent, the font
/// kPanelFontPixels times `scale` high. Between two frames; whoever holds the font's texture makes it anew.
void style_panel(float scale = 1);

/// The panel's scale in a picture: what was `asked` for; where that is 0, the monitor's own (`content`, 1
/// off-screen), more in pictures of more than 1080 lines, and less in ones in which it would not fit.
float ui_scale(float asked, float content, Size picture);

}  // namespace omentum::render
