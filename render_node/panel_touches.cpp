#include "render_node/panel_touches.h"

#include "render_node/panel_lines.h"
#include "render_node/touch_marks.h"

namespace omentum::render {
namespace {

std::string force_words(double newton) {
  return newton < 1 ? format("%.3g mN", 1e3 * newton) : format("%.3g N", newton);
}

// A square of each band's colour, and between two the force that parts them.
void colour_line() {
  ImGui::TextUnformatted("push");
  for (std::size_t b = 0; b < kTouchBands; ++b) {
    ImGui::SameLine();
    const float side = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side},
                                              ImGui::GetColorU32(shown(touch_colours()[b])));
    ImGui::Dummy({side, side});
    if (b + 1 == kTouchBands) break;
    ImGui::SameLine();
    ImGui::TextUnformatted(force_words(static_cast<double>(kTouchLimits_n[b])).c_str());
  }
}

}  // namespace

void lay_out_touches(const TouchRow& row) {
  if (!row.on) return;
  if (!row.known) return ImGui::TextDisabled("no pairs are told");
  figure("touching pairs", format("%zu", row.count));
  if (row.count > 0) figure("hardest push", force_words(row.hardest_n));
  colour_line();
}

}  // namespace omentum::render
