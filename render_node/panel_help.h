// What the keys and the mouse do, shown over the picture.
#pragma once

#include "render_node/panel_view.h"

#include <string>
#include <vector>

namespace omentum::render {

struct HelpLine {
  std::string what, does;
};
/// Of all that is of use: while a mouse moves an instrument, the camera has another button.
std::vector<HelpLine> help_lines(const PanelView& view);

/// In the middle of what the figures leave free. In the current Dear ImGui frame.
void lay_out_help(const PanelView& view);

}  // namespace omentum::render
