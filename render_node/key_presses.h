// What was typed at the window.
#pragma once

#include <cstdint>

namespace omentum::render {

/// The letters of the keyboard that went down since the last frame, as the person's layout names them,
/// however short they were down.
class KeyPresses {
 public:
  KeyPresses() = default;
  /// Of one letter, 'A' to 'Z'.
  explicit KeyPresses(char letter) { add(letter); }

  /// Anything but a letter is left out; small ones count as large ones.
  void add(char letter) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    if (letter >= 'A' && letter <= 'Z') letters_ |= std::uint32_t{1} << (letter - 'A');
  }
  bool has(char letter) const {
    return letter >= 'A' && letter <= 'Z' && ((letters_ >> (letter - 'A')) & 1) != 0;
  }

 private:
  std::uint32_t letters_ = 0;  // bit i: 'A' + i
};

}  // namespace omentum::render
