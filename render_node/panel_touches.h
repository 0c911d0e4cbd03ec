// What the panel says of parts that touch.
#pragma once

#include "render_node/panel_view.h"

namespace omentum::render {

/// How many there are and how hard they are pushed, with the colours' meaning; nothing while they are not
/// shown.
void lay_out_touches(const TouchRow& row);

}  // namespace omentum::render
