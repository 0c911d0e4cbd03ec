// The camera exercise of a session: looks at the target now and then, and scores who holds the scope.
#pragma once

#include "render_node/camera_target.h"

namespace omentum::render {

class CameraExercise {
 public:
  /// The organs must be at rest. Precondition: scene.score.camera.
  CameraExercise(const scene::Scene& scene, const SceneView& view)
      : target_(scene, view), score_(scene.score.camera->within_deg), from_s_(scene.score.from_s) {}

  /// At each picture; looks not more often than kPeriod_s: whether something hides the target is asked of
  /// every triangle. `now_s`: since the session's begin.
  void look(double now_s, const SceneView& view, std::span<const ToolNow> tools);
  nlohmann::json report() const;

  static constexpr double kPeriod_s = 0.05;

 private:
  CameraTarget target_;
  CameraScore score_;
  double from_s_, due_s_ = 0;
};

}  // namespace omentum::render
