#include "render_node/panel.h"

#include "render_node/panel_controls.h"
#include "render_node/panel_forces.h"
#include "render_node/panel_help.h"
#include "render_node/panel_lines.h"
#include "render_node/panel_organs.h"

#include <algorithm>

namespace omentum::render {
namespace {

void header(const PanelView& view) {
  const std::string right = view.paused ? "paused" : format("%.1f s", view.time_s);
  ImGui::TextUnformatted(beside(right, view.scene).c_str());
  ImGui::SameLine();
  right_aligned(right.c_str(), view.paused ? &kAmber : nullptr);
  ImGui::Separator();
}

void node_row(const NodeRow& row) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(row.name.c_str());
  ImGui::TableNextColumn();
  if (row.silent) return right_aligned("silent", &kRed);
  right_aligned(format("%.0f Hz", row.rate_hz).c_str());
  ImGui::TableNextColumn();
  right_aligned(duration(row.compute_us).c_str());
  ImGui::TableNextColumn();
  const std::string missed = format("%llu", static_cast<unsigned long long>(row.missed));
  right_aligned(missed.c_str(), row.misses_matter ? &kAmber : nullptr);
}

void node_table(const std::vector<NodeRow>& nodes) {
  constexpr std::size_t kShown = 6;  // the session's own, and a second hand's
  if (nodes.empty()) {
    ImGui::TextDisabled("waiting for the other nodes");
    return;
  }
  if (!ImGui::BeginTable("nodes", 4, ImGuiTableFlags_SizingStretchProp)) return;
  for (const auto& [name, weight] :
       {std::pair("node", 1.05f), {"rate", 1.15f}, {"compute", 1.2f}, {"missed", 0.95f}})
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, weight);
  ImGui::TableNextRow();
  for (const char* title : {"", "rate", "step", "missed"}) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    *title ? right_aligned(title) : ImGui::TextUnformatted(title);
    ImGui::PopStyleColor();
  }
  for (std::size_t n = 0; n < std::min(kShown, nodes.size()); ++n) node_row(nodes[n]);
  ImGui::EndTable();
  if (nodes.size() > kShown) ImGui::TextDisabled("and %zu more", nodes.size() - kShown);
}

void latency(const char* name, double p50_us, double p99_us) {
  if (p50_us <= 0) return;
  figure(name, duration(p50_us) + "  (p99 " + duration(p99_us) + ")");
}

float height_of(const std::string& fault) {
  const float width = ImGui::GetContentRegionAvail().x;
  return ImGui::CalcTextSize(fault.c_str(), nullptr, false, width).y + ImGui::GetStyle().ItemSpacing.y;
}

constexpr std::size_t kMostFaults = 4;  // the panel stays small; the report has all

// What as many faults as are shown take, the line that counts the others included.
float room_of(const std::vector<std::string>& faults) {
  float room = faults.size() > kMostFaults ? ImGui::GetTextLineHeightWithSpacing() : 0;
  for (std::size_t i = 0; i < std::min(kMostFaults, faults.size()); ++i) room += height_of(faults[i]);
  return room;
}

// One at least, and no more than fit above `bottom`.
void fault_list(const std::vector<std::string>& faults, float bottom) {
  if (faults.empty()) return;
  ImGui::Separator();
  ImGui::PushStyleColor(ImGuiCol_Text, kRed);
  ImGui::PushTextWrapPos(0);
  std::size_t shown = 0;
  const auto fits = [&] {
    const float more = shown + 1 < faults.size() ? ImGui::GetTextLineHeightWithSpacing() : 0;
    return ImGui::GetCursorScreenPos().y + height_of(faults[shown]) + more <= bottom;
  };
  while (shown < std::min(kMostFaults, faults.size()) && (shown == 0 || fits()))
    ImGui::TextUnformatted(faults[shown++].c_str());
  if (faults.size() > shown) ImGui::Text("and %zu more", faults.size() - shown);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

// To below the line that was laid out last; the window, where the mouse is the panel's, is as large.
void box_around_lines() {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float bottom = ImGui::GetCursorScreenPos().y - style.ItemSpacing.y + style.WindowPadding.y;
  const float margin = scaled(kPanelMargin), width = scaled(kPanelWidth);
  ImGui::GetBackgroundDrawList()->AddRectFilled({margin, margin}, {margin + width, bottom},
                                                ImGui::GetColorU32(ImGuiCol_WindowBg), style.WindowRounding);
  ImGui::SetWindowSize({width, bottom - margin});
}

void figures(const PanelView& view) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float margin = scaled(kPanelMargin);
  ImGui::SetNextWindowPos({margin, margin});
  // one that sizes itself would not be seen in its first frame, and cut what is new in any other
  ImGui::SetNextWindowSize({scaled(kPanelWidth), picture.y}, ImGuiCond_Once);
  ImGui::Begin("omentum", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushClipRect({0, 0}, picture, false);
  const float bottom = picture.y - margin - ImGui::GetStyle().WindowPadding.y;
  header(view);
  node_table(view.nodes);
  latency("hand to force", view.hand_to_force_us, view.hand_to_force_p99_us);
  latency("hand to picture", view.hand_to_picture_us, view.hand_to_picture_p99_us);
  if (!view.picture.empty()) figure("picture", view.picture);
  lay_out_forces(view);
  if (!view.mouse_help.empty()) ImGui::TextWrapped("%s", view.mouse_help.c_str());
  lay_out_organs(view, bottom - room_of(view.faults));
  fault_list(view.faults, bottom);
  ImGui::PopClipRect();
  box_around_lines();
  ImGui::End();
}

}  // namespace

double panel_share(Size picture, float ui_scale) {
  constexpr double kMost = 0.4;  // in a narrower picture the organ lies under the panel rather than outside
  return std::min(kMost, static_cast<double>(ui_scale * (kPanelWidth + kPanelMargin)) / picture.width);
}

PanelActions lay_out_panel(const PanelView& view) {
  figures(view);
  if (view.shows_help) lay_out_help(view);
  return view.interactive ? lay_out_controls(view) : PanelActions{};
}

}  // namespace omentum::render
