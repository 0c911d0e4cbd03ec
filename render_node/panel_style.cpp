#include "render_node/panel_style.h"

#include <imgui.h>

#include <array>
#include <filesystem>
#include <system_error>

namespace omentum::render {
namespace {

constexpr float kFontPixels = 15;
constexpr float kFallbackScale = 1.15f;  // Dear ImGui's own font is 13 pixels high

// DejaVu (package fonts-dejavu-core) where distributions put it; without it Dear ImGui's built-in font is
// used.
constexpr std::array<const char*, 3> kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                            "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void choose_font() {
  ImGuiIO& io = ImGui::GetIO();
  for (const char* file : kFonts) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) && io.Fonts->AddFontFromFileTTF(file, kFontPixels)) return;
  }
  io.Fonts->AddFontDefault();
  io.FontGlobalScale = kFallbackScale;
}

}  // namespace

void style_panel() {
  choose_font();
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 8;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.WindowPadding = {12, 10};
  style.ItemSpacing = {8, 5};
  style.CellPadding = {4, 2};
  style.WindowBorderSize = 0;
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
