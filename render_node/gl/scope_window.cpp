#include "render_node/gl/scope_window.h"

#include <epoxy/gl.h>

#include <cmath>

namespace omentum::render::gl {
namespace {

constexpr float kRadius = 1.075f;  // of half the height, where shaders/lens.frag is black
constexpr float kEdge = 4;         // pixels: a stretched picture's edge is a mixture of two of its own

}  // namespace

ScopeWindow::ScopeWindow(const Frame& frame, Size picture) : on_(frame.through_endoscope) {
  if (!on_) return;
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  const float half = kRadius * 0.5f * static_cast<float>(picture.height) + kEdge;
  const float middle = frame.middle * static_cast<float>(picture.width);
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<int>(std::floor(middle - half)), 0, static_cast<int>(std::ceil(2 * half)),
            picture.height);
}

ScopeWindow::~ScopeWindow() {
  if (on_) glDisable(GL_SCISSOR_TEST);
}

}  // namespace omentum::render::gl
