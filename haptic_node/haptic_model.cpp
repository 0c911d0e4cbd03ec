#include "haptic_node/haptic_model.h"

#include <stdexcept>
#include <string>

namespace omentum::haptic {

void require_solvable(const std::vector<ToolModel>& tools) {
  std::size_t points = 0;
  for (const ToolModel& tool : tools) points += tool.points.size();
  if (points > 0 && points <= physics::kMaxContacts) return;
  throw std::runtime_error("the tools have " + std::to_string(points) + " points together; expected 1 to " +
                           std::to_string(physics::kMaxContacts));
}

HapticState::HapticState(const HapticModel& model) {
  for (const ToolModel& tool : model.tools) {
    ToolState state;
    state.before.assign(tool.points.size(), Vec3::Zero());
    state.now = state.before;
    state.memories.resize(model.place_count() * tool.points.size());
    tools.push_back(std::move(state));
  }
  energies.resize(tools.size());
}

HapticWorkspace::HapticWorkspace(const HapticModel& model)
    : bodies(model.place_count()), doors(model.place_count()), works(model.tools.size()) {
  for (std::size_t i = 0; i < model.organs.size(); ++i) {
    const ElasticSurface& organ = model.organs[i];
    if (organ.surface.triangles.empty()) continue;
    const BodyOrigin origin{.organ = static_cast<std::uint32_t>(i), .file_node = organ.file_node};
    std::unique_ptr<Body> body =
        std::make_unique<DeformedSurface>(organ.surface, organ.rest, organ.compliance, origin);
    bodies.exchange(BodyId(i), body);
  }
}

}  // namespace omentum::haptic
