// An endoscope from outside: a steel tube, cut obliquely where its optics look.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// In T, m: the lens' middle is at the tip, its plane across the view axis (scope_spec.h).
MeshData scope_tube_mesh(float radius, float length, float optics_rad);
/// The dark lens, a disc just before the plane.
MeshData scope_lens_mesh(float radius, float optics_rad);
/// The ring of fibres around it, that the light comes from.
MeshData scope_fibres_mesh(float radius, float optics_rad);

}  // namespace omentum::render
