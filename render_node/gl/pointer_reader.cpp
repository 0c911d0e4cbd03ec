#include "render_node/gl/pointer_reader.h"

#include "transport/messages.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace omentum::render::gl {
namespace {

struct Level {
  int code;  // GLFW's
  std::uint32_t bit;
};

constexpr Level kButtons[] = {{GLFW_MOUSE_BUTTON_LEFT, msg::POINTER_LEFT},
                              {GLFW_MOUSE_BUTTON_RIGHT, msg::POINTER_RIGHT},
                              {GLFW_MOUSE_BUTTON_MIDDLE, msg::POINTER_MIDDLE}};
constexpr Level kKeys[] = {
    {GLFW_KEY_SPACE, msg::POINTER_KEY_CLOSE},     {GLFW_KEY_X, msg::POINTER_KEY_CUT},
    {GLFW_KEY_UP, msg::POINTER_KEY_AWAY},         {GLFW_KEY_DOWN, msg::POINTER_KEY_NEAR},
    {GLFW_KEY_LEFT, msg::POINTER_KEY_ROLL_LEFT},  {GLFW_KEY_RIGHT, msg::POINTER_KEY_ROLL_RIGHT},
    {GLFW_KEY_LEFT_SHIFT, msg::POINTER_KEY_TILT}, {GLFW_KEY_RIGHT_SHIFT, msg::POINTER_KEY_TILT}};

}  // namespace

Pointer PointerReader::read(GLFWwindow* window, float scrolled, bool taken) {
  Pointer pointer;
  int width = 0, height = 0;
  glfwGetWindowSize(window, &width, &height);
  double x = 0, y = 0;
  glfwGetCursorPos(window, &x, &y);
  const bool over = x >= 0 && y >= 0 && x < width && y < height;
  pointer.inside = over && !taken && glfwGetWindowAttrib(window, GLFW_ICONIFIED) == 0;
  if (width > 0 && height > 0) {
    pointer.x = static_cast<float>(x / width);
    pointer.y = static_cast<float>(y / height);
  }
  pointer.dx = static_cast<float>(x - x_);
  pointer.dy = static_cast<float>(y - y_);
  x_ = x;
  y_ = y;
  pointer.wheel = scrolled;
  for (const auto& [code, bit] : kButtons)
    if (glfwGetMouseButton(window, code) == GLFW_PRESS) pointer.buttons |= bit;
  const auto down = [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; };
  for (const auto& [code, bit] : kKeys)
    if (down(code)) pointer.keys |= bit;
  pointer.camera_key = down(GLFW_KEY_LEFT_CONTROL) || down(GLFW_KEY_RIGHT_CONTROL);
  const bool next = down(GLFW_KEY_TAB);
  pointer.next_tool = next && !next_key_;
  next_key_ = next;
  return pointer;
}

}  // namespace omentum::render::gl
