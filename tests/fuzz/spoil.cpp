#include "tests/fuzz/spoil.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace omentum::fuzz {

namespace {

using namespace std::string_view_literals;

// What breaks code that believes in numbers.
constexpr std::array kWords = {
    "0"sv,     "-1"sv,  "1"sv,    "4294967295"sv, "2147483648"sv, "18446744073709551615"sv,
    "1e400"sv, "nan"sv, "-inf"sv, "1e-320"sv,     ""sv,           "\""sv,
    "\n"sv,    "$"sv,   "<"sv,    "["sv,          "="sv,          " "sv};
constexpr std::array<std::uint64_t, 8> kNumbers = {
    0, 1, 0x7f, 0xff, 0x7fffffff, 0xffffffff, 0x7ff8000000000000, std::numeric_limits<std::uint64_t>::max()};
constexpr std::size_t kLongestPiece = 64;
constexpr int kKinds = 7, kMostChanges = 8;

class Spoiler {
 public:
  Spoiler(std::string& input, std::span<const std::string> inputs, std::mt19937_64& random)
      : input_(input), inputs_(inputs), random_(random) {}

  void change_once() {
    switch (below(kKinds)) {
      case 0:
        if (!input_.empty()) input_[below(input_.size())] ^= static_cast<char>(1U << below(8));
        break;
      case 1:
        overwrite_number();
        break;
      case 2:
        replace_piece(std::string(kWords[below(kWords.size())]));
        break;
      case 3:
        replace_piece("");
        break;
      case 4:
        input_.insert(below(input_.size() + 1), piece_of(input_));
        break;
      case 5:
        replace_piece(piece_of(inputs_[below(inputs_.size())]));
        break;
      default:
        if (below(4) == 0) input_.resize(below(input_.size() + 1));
    }
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }

  std::string piece_of(const std::string& from) {
    return from.substr(below(from.size() + 1), below(kLongestPiece));
  }
  void replace_piece(const std::string& by) {
    input_.replace(below(input_.size() + 1), below(std::max<std::size_t>(by.size() + 2, 8)), by);
  }
  void overwrite_number() {
    const std::uint64_t number = kNumbers[below(kNumbers.size())];
    const std::size_t bytes = std::size_t{1} << below(4), place = below(input_.size() + 1);
    const bool backwards = below(2) == 0;
    for (std::size_t i = 0; i < std::min(bytes, input_.size() - place); ++i)
      input_[place + i] = static_cast<char>(number >> (8 * (backwards ? bytes - 1 - i : i)));
  }

  std::string& input_;
  std::span<const std::string> inputs_;
  std::mt19937_64& random_;
};

}  // namespace

std::string spoilt(std::string input, std::span<const std::string> inputs, std::mt19937_64& random) {
  Spoiler spoiler(input, inputs, random);
  for (std::uint64_t left = 1 + random() % kMostChanges; left > 0; --left) spoiler.change_once();
  return input;
}

}  // namespace omentum::fuzz
