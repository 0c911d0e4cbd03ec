#include "render_node/panel_help.h"

#include "render_node/panel.h"
#include "render_node/panel_keys.h"
#include "render_node/panel_lines.h"

#include <algorithm>

namespace omentum::render {
namespace {

float widest(const std::vector<HelpLine>& lines, std::string HelpLine::*column) {
  float width = 0;
  for (const HelpLine& line : lines) width = std::max(width, ImGui::CalcTextSize((line.*column).c_str()).x);
  return width;
}

}  // namespace

std::vector<HelpLine> help_lines(const PanelView& view) {
  std::vector<HelpLine> lines;
  for (const ControlWord& word : control_words())
    if (is_of_use(word.control, view)) lines.push_back({std::string(1, word.key), word.does});
  if (view.mouse_help.empty()) {
    lines.push_back({"drag", "turn the orbit camera"});
    lines.push_back({"right drag", "move it (also the middle button)"});
    lines.push_back({"wheel", "zoom"});
  } else {  // as PointerRays::for_camera() has it
    lines.push_back({"middle drag", "turn the orbit camera (also Ctrl and left drag)"});
    lines.push_back({"Ctrl, right drag", "move it"});
    lines.push_back({"Ctrl, wheel", "zoom"});
  }
  return lines;
}

void lay_out_help(const PanelView& view) {
  constexpr float kGap = 18;  // pixels at scale 1, between both columns
  const std::vector<HelpLine> lines = help_lines(view);
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float first = widest(lines, &HelpLine::what) + scaled(kGap);
  const ImVec2 size{first + widest(lines, &HelpLine::does) + 2 * style.WindowPadding.x,
                    static_cast<float>(lines.size() + 1) * ImGui::GetTextLineHeightWithSpacing() +
                        2 * style.WindowPadding.y};
  const float left = scaled(kPanelWidth + 2 * kPanelMargin);
  // where the picture is too narrow, over the figures rather than outside
  const float x = std::max(scaled(kPanelMargin), std::min(0.5f * (left + picture.x - size.x),
                                                          picture.x - size.x - scaled(kPanelMargin)));
  ImGui::SetNextWindowPos({x, std::max(0.0f, 0.42f * (picture.y - size.y))});
  ImGui::SetNextWindowSize(size);
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextDisabled("keys and mouse");
  for (const HelpLine& line : lines) {
    const float begin = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(line.what.c_str());
    ImGui::SameLine(begin + first);
    ImGui::TextUnformatted(line.does.c_str());
  }
  ImGui::End();
}

}  // namespace omentum::render
