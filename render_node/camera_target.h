// Where the target is that who holds the camera keeps centred.
#pragma once

#include "render_node/scene_view.h"

namespace omentum::render {

/// Follows the scene's target: another tool's tip, or the vertex of an organ's picture that is nearest to the
/// place at rest.
class CameraTarget {
 public:
  /// The organs must be at rest. Precondition: scene.score.camera.
  CameraTarget(const scene::Scene& scene, const SceneView& view);

  /// In W, m; none while the tool is not seen.
  std::optional<Vec3> place(const SceneView& view, std::span<const ToolNow> tools) const;

 private:
  std::optional<std::size_t> tool_;  // its place among the scene's
  std::size_t organ_ = 0, vertex_ = 0;
};

}  // namespace omentum::render
