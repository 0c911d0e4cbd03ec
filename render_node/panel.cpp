#include "render_node/panel.h"

#include "render_node/panel_lines.h"
#include "render_node/scene_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr float kCurveHeight = 74, kCurveThickness = 1.8f;  // pixels
constexpr float kAxisWidth = 40;                            // pixels: "100 N"
constexpr double kKeepsUp = 0.98;  // of real time: what is less is seen as slow motion
const ImVec4 kRed{1.0f, 0.36f, 0.30f, 1};
const ImVec4 kAmber{1.0f, 0.74f, 0.28f, 1};

void header(const PanelView& view) {
  const std::string right = view.paused ? "paused" : format("%.1f s", view.time_s);
  ImGui::TextUnformatted(beside(right, view.scene).c_str());
  ImGui::SameLine();
  right_aligned(right.c_str(), view.paused ? &kAmber : nullptr);
  ImGui::Separator();
}

void node_table(const std::vector<NodeRow>& nodes) {
  if (nodes.empty()) {
    ImGui::TextDisabled("waiting for the other nodes");
    return;
  }
  if (!ImGui::BeginTable("nodes", 4, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("node", ImGuiTableColumnFlags_WidthStretch, 1.05f);
  ImGui::TableSetupColumn("rate", ImGuiTableColumnFlags_WidthStretch, 1.15f);
  ImGui::TableSetupColumn("compute", ImGuiTableColumnFlags_WidthStretch, 1.2f);
  ImGui::TableSetupColumn("missed", ImGuiTableColumnFlags_WidthStretch, 0.95f);
  ImGui::TableNextRow();
  for (const char* title : {"", "rate", "step", "missed"}) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    *title ? right_aligned(title) : ImGui::TextUnformatted(title);
    ImGui::PopStyleColor();
  }
  for (const NodeRow& row : nodes) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.name.c_str());
    ImGui::TableNextColumn();
    if (row.silent) {
      right_aligned("silent", &kRed);
      continue;
    }
    right_aligned(format("%.0f Hz", row.rate_hz).c_str());
    ImGui::TableNextColumn();
    right_aligned(duration(row.compute_us).c_str());
    ImGui::TableNextColumn();
    const std::string missed = format("%llu", static_cast<unsigned long long>(row.missed));
    right_aligned(missed.c_str(), row.misses_matter ? &kAmber : nullptr);
  }
  ImGui::EndTable();
}

void latency(const char* name, double p50_us, double p99_us) {
  if (p50_us <= 0) return;
  ImGui::TextUnformatted(name);
  ImGui::SameLine();
  right_aligned((duration(p50_us) + "  (p99 " + duration(p99_us) + ")").c_str());
}

// One line for each stretch without a gap.
void draw_curve(const ToolRow& tool, double now_s, double top_n, const ImVec2& corner, const ImVec2& size) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(shown(tool.colour));
  std::vector<ImVec2> line;
  const auto finish_line = [&] {
    draw.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, kCurveThickness);
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
  const ImVec2 corner{at.x + kAxisWidth, at.y};
  const ImVec2 size{ImGui::GetContentRegionAvail().x - kAxisWidth, kCurveHeight};
  const ImVec2 end{corner.x + size.x, corner.y + size.y};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), 4);
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
                                            ImGui::GetColorU32(shown(colour)), 2);
  ImGui::Dummy({side, ImGui::GetFontSize()});
  ImGui::SameLine();
}

void forces(const PanelView& view) {
  ImGui::Spacing();
  for (const ToolRow& tool : view.tools) {
    swatch(tool.colour);
    ImGui::TextUnformatted(tool.name.c_str());
    ImGui::SameLine();
    std::string words;
    for (const std::string& word : tool.state) words += (words.empty() ? "" : ", ") + word;
    if (!words.empty()) {
      if (tool.fault) {
        ImGui::TextColored(kRed, "%s", words.c_str());
      } else {
        ImGui::TextDisabled("%s", words.c_str());
      }
      ImGui::SameLine();
    }
    right_aligned(tool.present ? format("%.2f N", static_cast<double>(tool.force_n)).c_str() : "absent");
  }
  draw_curves(view);
}

void organ_line(const OrganRow& row, TissueMap map) {
  const std::string of = row.name.empty() ? "" : row.name + ": ";
  if (map != TissueMap::kOff && !row.mapped)
    ImGui::TextDisabled("%sno %s is told", of.c_str(), word(map).data());
  if (row.stale()) {
    const std::string age = format("%.0f s", 1e-9 * static_cast<double>(row.age_ns));
    ImGui::TextColored(kAmber, "%s%s for %s", of.c_str(),
                       row.known ? "organ stale: no state" : "no organ state", age.c_str());
  }
  if (row.removed_tetrahedra > 0) figure(of + "removed tetrahedra", format("%d", row.removed_tetrahedra));
  if (row.length_mm > 0) figure(of + "length", format("%.2f m", 1e-3 * row.length_mm));
  if (row.beyond_small_strains()) {
    ImGui::TextColored(kAmber, "%sstrained %.0f %%: beyond small strains (%.0f %%)", of.c_str(),
                       100 * *row.strained, 100 * kSmallStrain);
  }
  if (row.beyond_linear()) {
    ImGui::TextColored(kAmber, "%smoved %.0f mm: beyond linear range (%.0f mm)", of.c_str(), row.moved_mm,
                       row.limit_mm);
  }
}

double full_scale(const PanelView& view) {
  return view.map == TissueMap::kStress ? view.full_stress_pa : static_cast<double>(kFullStrain);
}

std::string in_words(TissueMap map, double value) {
  return map == TissueMap::kStress ? pressure(value) : format("%.1f %%", 100 * value);
}

// Of all organs that are drawn as the map.
void largest_line(const PanelView& view) {
  std::optional<double> largest;
  for (const OrganRow& row : view.organs) {
    const std::optional<double>& own = view.map == TissueMap::kStress ? row.stressed_pa : row.strained;
    if (row.mapped && own) largest = std::max(*own, largest.value_or(*own));
  }
  if (!largest) return;
  ImGui::TextUnformatted("largest");
  ImGui::SameLine();
  right_aligned(in_words(view.map, *largest).c_str());
}

// The map's colours from left to right, with what they mean at both ends.
void map_scale(const PanelView& view) {
  ImGui::TextUnformatted((std::string(word(view.map)) + "  0").c_str());
  ImGui::SameLine();
  const std::string most = in_words(view.map, full_scale(view));
  const float height = ImGui::GetFontSize();
  const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(most.c_str()).x -
                      ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float step = width / static_cast<float>(kMapColourCount - 1);
  for (std::size_t i = 0; i + 1 < kMapColourCount; ++i) {
    const float left = at.x + step * static_cast<float>(i);
    const ImU32 from = ImGui::GetColorU32(shown(map_colours()[i]));
    const ImU32 to = ImGui::GetColorU32(shown(map_colours()[i + 1]));
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor({left, at.y}, {left + step, at.y + height}, from, to,
                                                        to, from);
  }
  ImGui::Dummy({width, height});
  ImGui::SameLine();
  right_aligned(most.c_str());
}

void organs(const PanelView& view) {
  if (view.dents) figure("deepest dent", format("%.1f mm", view.dent_mm));
  if (view.exposed_share)
    figure(view.exposed_organ + " exposed", format("%.0f %%", 100 * *view.exposed_share));
  if (view.map != TissueMap::kOff) {
    map_scale(view);
    largest_line(view);
  }
  if (view.real_time_factor > 0) {
    const bool slow = view.real_time_factor < kKeepsUp;
    figure("real time", format("%.2f x", view.real_time_factor), slow ? &kAmber : nullptr);
  }
  ImGui::PushTextWrapPos(0);  // an organ may have a long name
  for (const OrganRow& row : view.organs) organ_line(row, view.map);
  ImGui::PopTextWrapPos();
  if (view.incomplete_states > 0) {
    ImGui::TextColored(kAmber, "%llu states came incomplete",
                       static_cast<unsigned long long>(view.incomplete_states));
  }
  if (view.arrows)
    ImGui::TextDisabled("arrow: force on the hand, %.0f mm = 1 N", 1e3 * kArrowMetresPerNewton);
}

void fault_list(const std::vector<std::string>& faults) {
  if (faults.empty()) return;
  constexpr std::size_t kShown = 4;  // the panel stays small; the report has all
  ImGui::Separator();
  ImGui::PushStyleColor(ImGuiCol_Text, kRed);
  ImGui::PushTextWrapPos(0);
  for (std::size_t i = 0; i < std::min(kShown, faults.size()); ++i) ImGui::TextUnformatted(faults[i].c_str());
  if (faults.size() > kShown) ImGui::Text("and %zu more", faults.size() - kShown);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

PanelActions buttons(const PanelView& view) {
  PanelActions actions;
  ImGui::Separator();
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
  if (ImGui::Button(view.paused ? "Start" : "Pause", {third, 0}))
    (view.paused ? actions.start : actions.pause) = true;
  ImGui::SameLine();
  actions.reset = ImGui::Button("Reset", {third, 0});
  ImGui::SameLine();
  actions.clear_fault = ImGui::Button("Clear fault", {third, 0});
  bool endoscope = view.endoscope, arrows = view.arrows, markers = view.markers;
  actions.switch_camera = ImGui::Checkbox("endoscope", &endoscope);
  ImGui::SameLine();
  actions.switch_arrows = ImGui::Checkbox("arrows", &arrows);
  ImGui::SameLine();
  actions.switch_markers = ImGui::Checkbox("nodes", &markers);
  actions.switch_map =
      ImGui::Button(("map: " + std::string(word(view.map)) + " (key S)" + kMapButton).c_str(), {-1, 0});
  ImGui::TextDisabled("%s", view.help.c_str());
  return actions;
}

// To below the line that was laid out last; the window, where the mouse is the panel's, is as large.
void box_around_lines() {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float bottom = ImGui::GetCursorScreenPos().y - style.ItemSpacing.y + style.WindowPadding.y;
  ImGui::GetBackgroundDrawList()->AddRectFilled({kPanelMargin, kPanelMargin},
                                                {kPanelMargin + kPanelWidth, bottom},
                                                ImGui::GetColorU32(ImGuiCol_WindowBg), style.WindowRounding);
  ImGui::SetWindowSize({kPanelWidth, bottom - kPanelMargin});
}

}  // namespace

double panel_share(Size picture) {
  constexpr double kMost = 0.4;  // in a narrower picture the organ lies under the panel rather than outside
  return std::min(kMost, static_cast<double>(kPanelWidth + kPanelMargin) / picture.width);
}

PanelActions lay_out_panel(const PanelView& view) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({kPanelMargin, kPanelMargin});
  // one that sizes itself would not be seen in its first frame, and cut what is new in any other
  ImGui::SetNextWindowSize({kPanelWidth, picture.y}, ImGuiCond_Once);
  ImGui::Begin("omentum", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushClipRect({0, 0}, picture, false);
  header(view);
  node_table(view.nodes);
  latency("hand to force", view.hand_to_force_us, view.hand_to_force_p99_us);
  latency("hand to picture", view.hand_to_picture_us, view.hand_to_picture_p99_us);
  forces(view);
  organs(view);
  fault_list(view.faults);
  const PanelActions actions = view.interactive ? buttons(view) : PanelActions{};
  ImGui::PopClipRect();
  box_around_lines();
  ImGui::End();
  return actions;
}

}  // namespace omentum::render
