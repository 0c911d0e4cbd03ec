#include "render_node/panel_style.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace omentum::render {
namespace {

constexpr float kFallbackPixels = 13;  // Dear ImGui's own font is so high, and blurs when it is larger

// The panel is made for pictures of up to full HD; on more of them its text would be too small to read.
constexpr float kLargestPlain = 1080;  // pixels, height
// A busy panel is about as high as this at scale 1: with less, it is smaller rather than cut off.
constexpr float kRoomNeeded = 600;                   // pixels, height
constexpr float kLeastScale = 0.6f, kSteps = 20.0f;  // 9 pixels; a new font every twentieth

// DejaVu (package fonts-dejavu-core) where distributions put it; without it Dear ImGui's built-in font is
// used.
constexpr std::array<const char*, 3> kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                            "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void choose_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  io.FontGlobalScale = 1;
  for (const char* file : kFonts) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) &&
        io.Fonts->AddFontFromFileTTF(file, scale * kPanelFontPixels))
      return;
  }
  io.Fonts->AddFontDefault();
  io.FontGlobalScale = scale * kPanelFontPixels / kFallbackPixels;
}

}  // namespace

float ui_scale(float asked, float content, Size picture) {
  if (asked > 0) return asked;
  const auto height = static_cast<float>(picture.height);
  const float wanted = std::max({1.0f, content, height / kLargestPlain});
  return std::round(kSteps * std::max(kLeastScale, std::min(wanted, height / kRoomNeeded))) / kSteps;
}

void style_panel(float scale) {
  choose_font(scale);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  ImGui::StyleColorsDark();
  style.WindowRounding = 8;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.WindowPadding = {12, 10};
  style.ItemSpacing = {8, 5};
  style.CellPadding = {4, 2};
  style.WindowBorderSize = 0;
  style.ScaleAllSizes(scale);
  const auto set = [&style](ImGuiCol which, ImVec4 colour) { style.Colors[which] = colour; };
  set(ImGuiCol_WindowBg, {0.035f, 0.045f, 0.055f, 0.80f});
  set(ImGuiCol_Text, {0.88f, 0.90f, 0.91f, 1});
  set(ImGuiCol_TextDisabled, {0.52f, 0.57f, 0.60f, 1});
  set(ImGuiCol_Button, {0.16f, 0.22f, 0.26f, 1});
  set(ImGuiCol_ButtonHovered, {0.22f, 0.32f, 0.38f, 1});
  set(ImGuiCol_ButtonActive, {0.12f, 0.42f, 0.52f, 1});
  set(ImGuiCol_FrameBg, {0.10f, 0.13f, 0.15f, 0.9f});
  set(ImGuiCol_FrameBgHovered, {0.15f, 0.20f, 0.23f, 1});
  set(ImGuiCol_FrameBgActive, {0.15f, 0.25f, 0.30f, 1});
  set(ImGuiCol_CheckMark, {0.30f, 0.75f, 0.88f, 1});
  set(ImGuiCol_Separator, {0.30f, 0.35f, 0.38f, 0.45f});
}

}  // namespace omentum::render
