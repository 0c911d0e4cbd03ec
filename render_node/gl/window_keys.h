// GLFW's keys as letters.
#pragma once

namespace omentum::render::gl {

/// The letter that a key typed, as the person's layout has it (`name`: glfwGetKeyName, may be null); where
/// that is no Latin one, the letter in its place on an American keyboard; 'H', for help, of F1; 0 of any
/// other key, and of one that is a command to the desktop, with Control, Alt or the logo key held.
char letter_of(int key, int modifiers, const char* name);

}  // namespace omentum::render::gl
