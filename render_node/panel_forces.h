// The panel's lines about the hands: what each feels, and how that went on.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

/// A line for each tool, and the curves of all of them, each in its tool's colour.
void lay_out_forces(const PanelView& view);

}  // namespace omentum::render
