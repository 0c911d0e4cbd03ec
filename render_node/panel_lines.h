// What the panel's lines are made of: figures in words, and text at the right.
#pragma once

#include "render_node/renderer.h"

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

/// Microseconds with three digits, so that a line's length is known.
std::string duration(double us);
std::string pressure(double pa);

/// The rest of the line, at its right end.
void right_aligned(const char* text, const ImVec4* colour = nullptr);
/// The text, or as much of it as fits beside what stands at the right.
std::string beside(const std::string& right, std::string text);
/// A line: what, and how much.
void figure(const std::string& of, const std::string& value, const ImVec4* colour = nullptr);

}  // namespace omentum::render
