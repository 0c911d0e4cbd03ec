// The panel's lines about the organs: what they are, what was made of them, what they are under.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

/// Lines of organs of which there are too many for the room above `bottom` (of the picture, pixels) are
/// counted instead.
void lay_out_organs(const PanelView& view, float bottom);

}  // namespace omentum::render
