#include "render_node/gl/window_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace omentum::render::gl {

char letter_of(int key, int modifiers, const char* name) {
  if ((modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return 0;
  if (key == GLFW_KEY_F1) return 'H';
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (name != nullptr && is_letter(name[0]) && name[1] == 0) return name[0];
  // a comma on the key that is an M elsewhere is no M; a Cyrillic letter is one of several bytes
  if (name != nullptr && name[0] > 0) return 0;
  return key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? static_cast<char>('A' + (key - GLFW_KEY_A)) : 0;
}

}  // namespace omentum::render::gl
