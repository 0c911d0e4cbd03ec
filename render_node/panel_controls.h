// The panel's buttons.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

/// A bar at the lower edge of the picture, beside the figures, in as many rows as it takes; each button with
/// its key. Tells what was pressed.
PanelActions lay_out_controls(const PanelView& view);

}  // namespace omentum::render
