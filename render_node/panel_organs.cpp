#include "render_node/panel_organs.h"

#include "render_node/panel_lines.h"
#include "render_node/panel_touches.h"
#include "render_node/scene_view.h"

#include <algorithm>

namespace omentum::render {
namespace {

constexpr double kKeepsUp = 0.98;  // of real time: what is less is seen as slow motion

void size_line(const OrganRow& row) {
  if (row.nodes == 0) return;
  std::string size = std::to_string(row.nodes) + " nodes";
  if (row.tetrahedra > 0) size += ", " + std::to_string(row.tetrahedra) + " tetrahedra";
  figure(row.name.empty() ? "organ" : row.name, size);
}

void organ_lines(const OrganRow& row, TissueMap map) {
  const std::string of = row.name.empty() ? "" : row.name + ": ";
  size_line(row);
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
  if (largest) figure("largest", in_words(view.map, *largest));
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

void scene_lines(const PanelView& view) {
  if (view.dents) figure("deepest dent", format("%.1f mm", view.dent_mm));
  if (view.exposed_share)
    figure(view.exposed_organ + " exposed", format("%.0f %%", 100 * *view.exposed_share));
  // where nothing is drawn by it a scale would promise colours; each organ's line says that nothing is told
  if (view.map != TissueMap::kOff && std::ranges::any_of(view.organs, &OrganRow::mapped)) {
    map_scale(view);
    largest_line(view);
  }
  lay_out_touches(view.touches);
  if (view.real_time_factor > 0) {
    const bool slow = view.real_time_factor < kKeepsUp;
    figure("real time", format("%.2f x", view.real_time_factor), slow ? &kAmber : nullptr);
  }
}

}  // namespace

void lay_out_organs(const PanelView& view, float bottom) {
  scene_lines(view);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float below = line * static_cast<float>(1 + (view.incomplete_states > 0) + view.arrows);
  std::size_t shown = 0;
  ImGui::PushTextWrapPos(0);  // an organ may have a long name
  for (; shown < view.organs.size(); ++shown) {
    if (shown > 0 && ImGui::GetCursorScreenPos().y + line + below > bottom) break;
    organ_lines(view.organs[shown], view.map);
  }
  ImGui::PopTextWrapPos();
  if (shown < view.organs.size()) ImGui::TextDisabled("and %zu more organs", view.organs.size() - shown);
  if (view.incomplete_states > 0) {
    ImGui::TextColored(kAmber, "%llu states came incomplete",
                       static_cast<unsigned long long>(view.incomplete_states));
  }
  if (view.arrows)
    ImGui::TextDisabled("arrow: force on the hand, %.0f mm = 1 N", 1e3 * kArrowMetresPerNewton);
}

}  // namespace omentum::render
