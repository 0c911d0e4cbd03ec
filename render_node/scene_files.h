// What the node reads from files before it joins the domain.
#pragma once

#include "render_node/inbox.h"
#include "render_node/organ_drawing.h"
#include "runtime/node_options.h"
#include "scene/scene.h"

#include <vector>

namespace omentum::render {

/// A scene and its organs, in its order: as states are judged by, and as they are drawn.
struct SceneFiles {
  scene::Scene scene;
  std::vector<LoadedOrgan> organs;
  std::vector<OrganShape> shapes;
};

/// Throws what and where.
SceneFiles read_scene_files(const runtime::NodeOptions& options);

}  // namespace omentum::render
