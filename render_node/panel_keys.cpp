#include "render_node/panel_keys.h"

#include <algorithm>

namespace omentum::render {

const std::array<ControlWord, kControlCount>& control_words() {
  static constexpr std::array<ControlWord, kControlCount> kWords{
      {{Control::kFlow, 'P', "pause, or go on", "###P"},
       {Control::kReset, 'R', "reset: organs back to rest", "###R"},
       {Control::kClearFault, 'C', "clear a latched fault of the force", "###C"},
       {Control::kRecord, 'V', "record a video, or end it", "###V"},
       {Control::kCamera, 'O', "orbit camera or endoscope", "###O"},
       {Control::kArrows, 'F', "arrows of the forces on the hands", "###F"},
       {Control::kContacts, 'N', "nodes in contact", "###N"},
       {Control::kTouches, 'T', "pairs of parts that touch, coloured by their push", "###T"},
       {Control::kWires, 'L', "lines: the triangles of the organs", "###L"},
       {Control::kFolds, 'G', "gut coloured by how sharply it is folded", "###G"},
       {Control::kMap, 'S', "map of strain, of stress, or none", "###S"},
       {Control::kHelp, 'H', "this help (also F1)", "###H"}}};
  return kWords;
}

const ControlWord& word_of(Control control) {
  return *std::ranges::find(control_words(), control, &ControlWord::control);
}

bool is_of_use(Control control, const PanelView& view) {
  return control != Control::kFolds || view.has_tube;
}

void ask_for(Control control, const PanelView& view, PanelActions& actions) {
  switch (control) {
    case Control::kFlow:
      (view.paused ? actions.start : actions.pause) = true;
      break;
    case Control::kReset:
      actions.reset = true;
      break;
    case Control::kClearFault:
      actions.clear_fault = true;
      break;
    case Control::kRecord:
      (view.recording.on ? actions.stop_recording : actions.record) = true;
      break;
    case Control::kCamera:
      actions.switch_camera = true;
      break;
    case Control::kArrows:
      actions.switch_arrows = true;
      break;
    case Control::kContacts:
      actions.switch_markers = true;
      break;
    case Control::kWires:
      actions.switch_wires = true;
      break;
    case Control::kTouches:
      actions.switch_touches = true;
      break;
    case Control::kFolds:
      actions.switch_folds = view.has_tube;
      break;
    case Control::kMap:
      actions.switch_map = true;
      break;
    case Control::kHelp:
      actions.switch_help = true;
      break;
  }
}

PanelActions actions_of(const KeyPresses& keys, const PanelView& view) {
  PanelActions actions;
  for (const ControlWord& word : control_words())
    if (keys.has(word.key)) ask_for(word.control, view, actions);
  return actions;
}

}  // namespace omentum::render
