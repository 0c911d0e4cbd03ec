// An electric hook: what it cuts with, on what.
#pragma once

#include "render_node/renderer.h"
#include "scene/scene.h"

namespace omentum::render {

/// The wire along the tool's edge, and to it from the shaft's axis where the edge is beside that, in T, m.
/// Precondition: the tool has an edge.
MeshData wire_mesh(const scene::ToolSpec& tool);

/// What does not cut: the ball that the tool's points lie on, of `ball_radius`, and its neck up to `to`, m.
MeshData ball_mesh(float ball_radius, float to);

/// Where the ceramic begins that insulates the neck, m: behind the ball and the edge.
float ceramic_from(const scene::ToolSpec& tool, float ball_radius);

}  // namespace omentum::render
