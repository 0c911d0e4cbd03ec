#include "render_node/view_choices.h"

namespace omentum::render {

void choose(const PanelActions& actions, ViewChoices& choices) {
  choices.endoscope ^= actions.switch_camera;
  choices.arrows ^= actions.switch_arrows;
  choices.markers ^= actions.switch_markers;
  choices.wires ^= actions.switch_wires;
  choices.folds ^= actions.switch_folds;
}

void tell(const ViewChoices& choices, PanelView& panel) {
  panel.endoscope = choices.endoscope;
  panel.arrows = choices.arrows;
  panel.markers = choices.markers;
  panel.wires = choices.wires;
  panel.folds = choices.folds;
  panel.map = choices.map;
}

}  // namespace omentum::render
