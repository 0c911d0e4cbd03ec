#include "render_node/panel_forces.h"

#include "render_node/panel_lines.h"

#include <algorithm>

namespace omentum::render {
namespace {

constexpr float kCurveHeight = 74, kCurveThickness = 1.8f;  // pixels at scale 1
constexpr float kAxisWidth = 40;                            // "100 N"

// One line for each stretch without a gap.
void draw_curve(const ToolRow& tool, double now_s, double top_n, const ImVec2& corner, const ImVec2& size) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(shown(tool.colour));
  std::vector<ImVec2> line;
  const auto finish_line = [&] {
    draw.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, scaled(kCurveThickness));
    line.clear();
  };
  for (const auto& sample : tool.curve) {
    if (sample.after_gap) finish_line();
    const double age = now_s - sample.time_s;
    line.push_back({corner.x + size.x * static_cast<float>(1 - age / ForceHistory::kSpan_s),
                    corner.y + (size.y - 2) * static_cast<float>(1 - sample.force_n / top_n) + 1});
  }
  finish_line();
}

// The axis beside the curves, not on them: two numbers on the left, two times below.
void label_axes(double top_n, const ImVec2& corner, const ImVec2& size) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float left = ImGui::GetCursorScreenPos().x, line = ImGui::GetFontSize();
  draw.AddText({left, corner.y}, dim, format("%g N", top_n).c_str());
  draw.AddText({left, corner.y + size.y - line}, dim, "0 N");
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y + 1});
  ImGui::TextDisabled("%.0f s ago", ForceHistory::kSpan_s);
  ImGui::SameLine();
  right_aligned("now", &ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
}

void draw_curves(const PanelView& view) {
  float largest = 0;
  for (const ToolRow& tool : view.tools) largest = std::max(largest, tool.largest_n);
  const double top = force_axis_n(largest);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 corner{at.x + scaled(kAxisWidth), at.y};
  const ImVec2 size{ImGui::GetContentRegionAvail().x - scaled(kAxisWidth), scaled(kCurveHeight)};
  const ImVec2 end{corner.x + size.x, corner.y + size.y};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), ImGui::GetStyle().FrameRounding);
  for (const float share : {0.25f, 0.5f, 0.75f}) {
    const float y = corner.y + share * size.y;
    draw.AddLine({corner.x, y}, {end.x, y}, IM_COL32(255, 255, 255, 16));
  }
  draw.PushClipRect(corner, end, true);
  for (const ToolRow& tool : view.tools) draw_curve(tool, view.time_s, top, corner, size);
  draw.PopClipRect();
  label_axes(top, corner, size);
}

void swatch(const Vec3f& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = 0.62f * ImGui::GetFontSize();
  const float top = at.y + 0.25f * ImGui::GetFontSize();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side},
                                            ImGui::GetColorU32(shown(colour)), scaled(2));
  ImGui::Dummy({side, ImGui::GetFontSize()});
  ImGui::SameLine();
}

// What force safety did stands before the force, and a long name gives way to it.
void tool_line(const ToolRow& tool) {
  swatch(tool.colour);
  std::string words;
  for (const std::string& word : tool.state) words += (words.empty() ? "" : ", ") + word;
  std::string force = "absent";
  if (tool.present) force = format("%.2f N", static_cast<double>(tool.force_n));
  if (tool.most_n > 0) force += format(", most %.2f", static_cast<double>(tool.most_n));
  const std::string right = words.empty() ? force : words + "   " + force;
  ImGui::TextUnformatted(beside(right, tool.name).c_str());
  if (!words.empty()) {
    ImGui::SameLine();
    const std::string fitting = beside(force, words);
    if (tool.fault) {
      ImGui::TextColored(kRed, "%s", fitting.c_str());
    } else {
      ImGui::TextDisabled("%s", fitting.c_str());
    }
  }
  ImGui::SameLine();
  right_aligned(force.c_str());
}

}  // namespace

void lay_out_forces(const PanelView& view) {
  ImGui::Spacing();
  for (const ToolRow& tool : view.tools) tool_line(tool);
  draw_curves(view);
}

}  // namespace omentum::render
