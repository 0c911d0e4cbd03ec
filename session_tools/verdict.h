// What became of one requirement.
#pragma once

#include <cstdio>
#include <string>

namespace omentum::session {

/// As printf; a line of a verdict, cut off where it is longer than any.
template <class... Values>
std::string text(const char* format, Values... values) {
  constexpr std::size_t kLongest = 200;
  char line[kLongest];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

struct Verdict {
  enum class Outcome : unsigned char { kPassed, kFailed, kUnseen };
  std::string requirement;
  Outcome outcome = Outcome::kUnseen;
  std::string detail;  // what was seen, and where it failed what was expected
};

/// Passed or failed.
inline Verdict verdict(std::string requirement, bool passed, std::string detail) {
  return {std::move(requirement), passed ? Verdict::Outcome::kPassed : Verdict::Outcome::kFailed,
          std::move(detail)};
}
/// Nothing happened by which it could be judged; `detail` says what to do about it.
inline Verdict unseen(std::string requirement, std::string detail) {
  return {std::move(requirement), Verdict::Outcome::kUnseen, std::move(detail)};
}

}  // namespace omentum::session
