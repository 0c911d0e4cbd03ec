#include "render_node/panel_lines.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {

ImVec4 shown(const Vec3f& linear) {
  return {std::sqrt(linear.x()), std::sqrt(linear.y()), std::sqrt(linear.z()), 1};
}

float scaled(float pixels) {
  return pixels * ImGui::GetFontSize() / kPanelFontPixels;
}

void right_aligned(const char* text, const ImVec4* colour) {
  const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, space));
  if (colour) {
    ImGui::TextColored(*colour, "%s", text);
  } else {
    ImGui::TextUnformatted(text);
  }
}

std::string duration(double us) {
  if (us < 1000) return format("%.0f us", us);
  if (us < 100e3) return format("%.1f ms", us / 1000);
  return us < 1e6 ? format("%.0f ms", us / 1000) : format("%.1f s", us / 1e6);
}

std::string pressure(double pa) {
  return pa < 1000 ? format("%.0f Pa", pa) : format("%.1f kPa", pa / 1000);
}

std::string beside(const std::string& right, std::string text) {
  const float space = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x -
                      ImGui::CalcTextSize(right.c_str()).x;
  if (ImGui::CalcTextSize(text.c_str()).x <= space) return text;
  constexpr const char* kCut = "...";
  while (!text.empty() && ImGui::CalcTextSize((text + kCut).c_str()).x > space) text.pop_back();
  return text + kCut;
}

void figure(const std::string& of, const std::string& value, const ImVec4* colour) {
  ImGui::TextUnformatted(beside(value, of).c_str());
  ImGui::SameLine();
  right_aligned(value.c_str(), colour);
}

}  // namespace omentum::render
