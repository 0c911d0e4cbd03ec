#include "render_node/view_choices.h"

#include "render_node/render_loop.h"

namespace omentum::render {

ViewChoices first_choices(const RenderOptions& options, const scene::Scene& scene, const Camera& orbit) {
  return {.orbit = orbit,
          .endoscope = scene.camera.mode == "endoscope",
          .folds = options.folds,
          .touches = options.touches};
}

void choose(const PanelActions& actions, ViewChoices& choices) {
  choices.endoscope ^= actions.switch_camera;
  choices.arrows ^= actions.switch_arrows;
  choices.markers ^= actions.switch_markers;
  choices.touches ^= actions.switch_touches;
  choices.wires ^= actions.switch_wires;
  choices.folds ^= actions.switch_folds;
}

void tell(const ViewChoices& choices, PanelView& panel) {
  panel.endoscope = choices.endoscope;
  panel.arrows = choices.arrows;
  panel.markers = choices.markers;
  panel.touches.on = choices.touches;
  panel.wires = choices.wires;
  panel.folds = choices.folds;
  panel.map = choices.map;
}

}  // namespace omentum::render
