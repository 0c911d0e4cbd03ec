#include "render_node/camera_exercise.h"

#include <nlohmann/json.hpp>

namespace omentum::render {

void CameraExercise::look(double now_s, const SceneView& view, std::span<const ToolNow> tools) {
  if (now_s < from_s_ || now_s < due_s_) return;
  due_s_ = now_s + kPeriod_s;
  const std::optional<Vec3> target = target_.place(view, tools);
  const std::optional<CameraMoment> moment = target ? view.scope_moment(*target, tools) : std::nullopt;
  if (moment) {
    score_.add(now_s, *moment);
  } else {
    score_.skip(now_s);
  }
}

nlohmann::json CameraExercise::report() const {
  return score_.report();
}

}  // namespace omentum::render
