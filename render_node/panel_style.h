// The panel's font and colours.
#pragma once

namespace omentum::render {

/// Sets font, spacing and colours of the current Dear ImGui context: calm, dark, translucent, 15 pixels high.
void style_panel();

}  // namespace omentum::render
