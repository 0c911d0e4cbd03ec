// What a person can ask for at the panel, each with its key.
#pragma once

#include "render_node/key_presses.h"
#include "render_node/panel_view.h"

#include <array>
#include <cstddef>

namespace omentum::render {

/// A wish: a button of the panel and a key of the window.
enum class Control : std::uint8_t {
  kFlow,  // pause or start, whichever it is not
  kReset,
  kClearFault,
  kRecord,
  kCamera,
  kArrows,
  kContacts,
  kWires,
  kTouches,
  kFolds,
  kMap,
  kHelp
};
inline constexpr std::size_t kControlCount = 12;

struct ControlWord {
  Control control{};
  char key = ' ';              // 'A' to 'Z'; the terminal of launch_scripts/run has the same
  const char* does = "";       // in the help
  const char* button_id = "";  // Dear ImGui's: labels change
};
/// In the order in which they are shown.
const std::array<ControlWord, kControlCount>& control_words();
const ControlWord& word_of(Control control);
/// Whether there is anything that it would change.
bool is_of_use(Control control, const PanelView& view);

/// Adds what `control` does to `actions`, which then are done.
void ask_for(Control control, const PanelView& view, PanelActions& actions);
/// Of all keys that went down.
PanelActions actions_of(const KeyPresses& keys, const PanelView& view);

}  // namespace omentum::render
