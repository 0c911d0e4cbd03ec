#include "render_node/panel_controls.h"

#include "render_node/panel.h"
#include "render_node/panel_keys.h"
#include "render_node/panel_lines.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

const ImVec4 kSwitchedOn{0.10f, 0.36f, 0.45f, 1};
const ImVec4 kRecording{0.55f, 0.12f, 0.10f, 1};
constexpr float kLeastWidth = 330;  // of the bar, pixels at scale 1: with less it goes below the figures

struct Button {
  std::string label;  // with its key
  const ImVec4* lit = nullptr;
};

std::string recording_words(const RecordingRow& recording) {
  const auto seconds = static_cast<int>(recording.seconds);
  return recording.on ? format("Stop %d:%02d", seconds / 60, seconds % 60) : "Record";
}

Button button_of(Control control, const PanelView& view) {
  const auto lit = [](bool on) { return on ? &kSwitchedOn : nullptr; };
  switch (control) {
    case Control::kFlow:
      return {view.paused ? "Start" : "Pause", lit(view.paused)};
    case Control::kReset:
      return {"Reset"};
    case Control::kClearFault:
      return {"Clear fault"};
    case Control::kRecord:
      return {recording_words(view.recording), view.recording.on ? &kRecording : nullptr};
    case Control::kCamera:
      return {view.endoscope ? "Scope" : "Orbit", lit(view.endoscope)};
    case Control::kArrows:
      return {"Forces", lit(view.arrows)};
    case Control::kContacts:
      return {"Contacts", lit(view.markers)};
    case Control::kWires:
      return {"Lines", lit(view.wires)};
    case Control::kTouches:
      return {"Pairs", lit(view.touches.on)};
    case Control::kFolds:
      return {"Folds", lit(view.folds)};
    case Control::kMap:
      return {"Map: " + std::string(word(view.map)), lit(view.map != TissueMap::kOff)};
    default:
      return {"Help", lit(view.shows_help)};
  }
}

// What is written on the widest of all buttons, whatever is on.
float widest_label() {
  float widest = 0;
  for (const char* label : {"Clear fault", "Map: strain", "Map: stress", "Stop 00:00"})
    widest = std::max(widest, ImGui::CalcTextSize((std::string(label) + "  W").c_str()).x);
  return widest + 2 * ImGui::GetStyle().FramePadding.x;
}

struct Bar {
  float left = 0, width = 0;  // pixels of the picture
  int columns = 1, rows = 1;
};

Bar bar_in(const ImVec2& picture, int count) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float margin = scaled(kPanelMargin), beside = scaled(kPanelWidth) + 2 * margin;
  Bar bar{beside, picture.x - beside - margin};
  if (bar.width < scaled(kLeastWidth)) bar = {margin, picture.x - 2 * margin};
  const float inside = bar.width - 2 * style.WindowPadding.x + style.ItemSpacing.x;
  const int fitting = std::max(1, static_cast<int>(inside / (widest_label() + style.ItemSpacing.x)));
  bar.rows = (count + fitting - 1) / fitting;
  bar.columns = (count + bar.rows - 1) / bar.rows;
  return bar;
}

bool draw(const ControlWord& word, const Button& button, float width) {
  if (button.lit) ImGui::PushStyleColor(ImGuiCol_Button, *button.lit);
  const std::string key{"  ", 2};
  const bool pressed = ImGui::Button((button.label + key + word.key + word.button_id).c_str(), {width, 0});
  if (button.lit) ImGui::PopStyleColor();
  return pressed;
}

}  // namespace

PanelActions lay_out_controls(const PanelView& view) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const ImGuiStyle& style = ImGui::GetStyle();
  const auto is_shown = [&](const ControlWord& word) { return is_of_use(word.control, view); };
  const Bar bar = bar_in(picture, static_cast<int>(std::ranges::count_if(control_words(), is_shown)));
  const auto rows = static_cast<float>(bar.rows), columns = static_cast<float>(bar.columns);
  const float padding = std::round(0.6f * style.WindowPadding.y);
  const float height = rows * (ImGui::GetFrameHeight() + style.ItemSpacing.y) - style.ItemSpacing.y;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.WindowPadding.x, padding));
  ImGui::SetNextWindowPos({bar.left, picture.y - height - 2 * padding - scaled(kPanelMargin)});
  ImGui::SetNextWindowSize({bar.width, height + 2 * padding});
  ImGui::Begin("controls", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoScrollWithMouse);
  const float width = (ImGui::GetContentRegionAvail().x - (columns - 1) * style.ItemSpacing.x) / columns;
  PanelActions actions;
  int place = 0;
  for (const ControlWord& word : control_words()) {
    if (!is_shown(word)) continue;
    if (place++ % bar.columns != 0) ImGui::SameLine();
    if (draw(word, button_of(word.control, view), width)) ask_for(word.control, view, actions);
  }
  ImGui::End();
  ImGui::PopStyleVar();
  return actions;
}

}  // namespace omentum::render
