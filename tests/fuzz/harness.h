// What each harness here offers to the engines that feed it: libFuzzer (launch_scripts/fuzz) and the plain
// one of the test command (replay.cpp).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace omentum::fuzz {

/// Tries one input. Whatever it is, what is under test answers or refuses it in its own words; what must hold
/// of an answer is checked here, and a breach ends the program (broken()).
void try_input(std::span<const std::uint8_t> input);

/// Well-formed inputs to begin with: those of the tests, and what was found stays in corpus/.
std::vector<std::string> seeds();

/// Says what was breached and aborts, as a sanitizer does.
[[noreturn]] void broken(std::string_view what);

inline std::string_view text_of(std::span<const std::uint8_t> input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

}  // namespace omentum::fuzz
