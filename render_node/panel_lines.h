// What the panel's lines are made of: figures in words, and text at the right.
#pragma once

#include "render_node/panel_style.h"

#include <imgui.h>

#include <array>
#include <cstdio>
#include <string>

namespace omentum::render {

/// A linear colour as the panel shows it: as the film does.
ImVec4 shown(const Vec3f& linear);

/// At most 63 characters.
template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, args...);
  return text.data();
}

/// Pixels of a panel of scale 1 as pixels of this one.
float scaled(float pixels);

/// Microseconds with three digits, so that a line's length is known.
std::string duration(double us);
std::string pressure(double pa);

inline const ImVec4 kRed{1.0f, 0.36f, 0.30f, 1};
inline const ImVec4 kAmber{1.0f, 0.74f, 0.28f, 1};

/// The rest of the line, at its right end.
void right_aligned(const char* text, const ImVec4* colour = nullptr);
/// The text, or as much of it as fits beside what stands at the right.
std::string beside(const std::string& right, std::string text);
/// A line: what, and how much.
void figure(const std::string& of, const std::string& value, const ImVec4* colour = nullptr);

}  // namespace omentum::render
