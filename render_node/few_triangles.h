// A mesh that stands still, in few triangles.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render {

/// Fills `few` (MeshData): vertices that share a cube of that side, m, and one of eight directions of their
/// normals become the first of them, and triangles between fewer than three of those, or turned over, go
/// (vertex clustering: Rossignac and Borrel, Modeling in Computer Graphics, 1993). What is longer than a cube
/// stays as long; edges stay edges, as normals on both sides differ. Stays empty where little would be
/// gained.
void add_few_triangles(MeshData& mesh, float side_m);

}  // namespace omentum::render
