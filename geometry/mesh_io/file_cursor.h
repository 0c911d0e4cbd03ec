// A mesh file in memory with a reading position: tokens and binary values, and errors that name the line.
#pragma once

#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

namespace omentum::geometry {

/// Reads front to back. Every reader takes `expected`, what should stand there in words, and throws
/// InputError "FILE:LINE: found ..., expected ..." when something else does.
class FileCursor {
 public:
  /// Reads the whole file and passes over a byte order mark; throws InputError when it is missing, unreadable
  /// or empty.
  explicit FileCursor(const std::filesystem::path& file);

  const std::string& name() const { return name_; }
  std::size_t remaining() const { return text_.size() - position_; }

  /// Skips white space; true when nothing follows.
  bool at_end();
  /// Whether the next character is `c`.
  bool next_is(char c) const { return position_ < text_.size() && text_[position_] == c; }
  /// The next word up to white space.
  std::string_view word(const char* expected);
  /// The rest of the current line without its line break, which is passed over.
  std::string_view rest_of_line();
  /// Moves behind the next occurrence of `mark`; false (and no move) when there is none.
  bool skip_past(std::string_view mark);
  double real(const char* expected);
  std::int64_t integer(const char* expected);
  /// A number of things still to come in this file, each of at least one byte.
  std::size_t count(const char* expected);

  /// A value as it lies in memory, of the given byte order.
  template <class T>
  T binary(const char* expected, std::endian order = std::endian::native) {
    if (remaining() < sizeof(T)) fail("the end of the file", expected);
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), text_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  /// Passes over what is not looked at.
  void skip(std::size_t bytes, const char* expected) {
    if (remaining() < bytes) fail("the end of the file", expected);
    position_ += bytes;
  }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;

 private:
  std::string name_;
  std::string text_;
  std::size_t position_ = 0;
  std::size_t word_start_ = 0;  // where the newest word began: errors point there
};

}  // namespace omentum::geometry
