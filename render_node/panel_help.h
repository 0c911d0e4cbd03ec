// What the keys and the mouse do, shown over the picture.
#pragma once

namespace omentum::render {

/// In the middle of what the figures leave free. In the current Dear ImGui frame.
void lay_out_help();

}  // namespace omentum::render
