// A gut as it is drawn: its tube and its mesentery.
#pragma once

#include "geometry/gut_shape.h"
#include "render_node/organ_drawing.h"

namespace omentum::render {

/// Whose states are the places of all masses, row by row (KIND_TUBE of idl/organ.idl). The mesentery is its
/// one part. Tools dent it not: they move it.
std::unique_ptr<OrganDrawing> make_tube_drawing(const geometry::GutShape& rest, const Material& wall);

}  // namespace omentum::render
