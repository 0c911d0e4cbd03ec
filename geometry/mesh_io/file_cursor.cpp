#include "geometry/mesh_io/file_cursor.h"

#include "geometry/mesh_io/byte_order_mark.h"

#include <charconv>
#include <fstream>

namespace omentum::geometry {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// What a message shows of an offending word: a binary file read as text must not flood the terminal.
std::string printable(std::string_view text) {
  constexpr std::size_t kShown = 24;
  std::string shown(text.substr(0, kShown));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + shown + (text.size() > kShown ? "...'" : "'");
}

// from_chars refuses the plus sign that some writers put.
template <class T>
bool parse(std::string_view word, T& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

FileCursor::FileCursor(const std::filesystem::path& file) : name_(file.string()) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(name_ + ": no such file; expected a mesh file");
  std::ifstream stream(file, std::ios::binary);
  text_.resize(std::filesystem::file_size(file));
  if (!stream.read(text_.data(), static_cast<std::streamsize>(text_.size()))) {
    throw InputError(name_ + ": cannot be read");
  }
  if (text_.empty()) throw InputError(name_ + ": is empty; expected a mesh file");
  if (text_.starts_with(kByteOrderMark)) position_ = word_start_ = kByteOrderMark.size();
}

bool FileCursor::at_end() {
  while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  return position_ == text_.size();
}

std::string_view FileCursor::word(const char* expected) {
  const bool nothing = at_end();
  word_start_ = position_;
  if (nothing) fail("the end of the file", expected);
  while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
  return std::string_view(text_).substr(word_start_, position_ - word_start_);
}

std::string_view FileCursor::rest_of_line() {
  word_start_ = position_;
  std::size_t end = text_.find('\n', position_);
  if (end == std::string::npos) end = text_.size();
  position_ = std::min(end + 1, text_.size());
  if (end > word_start_ && text_[end - 1] == '\r') --end;
  return std::string_view(text_).substr(word_start_, end - word_start_);
}

bool FileCursor::skip_past(std::string_view mark) {
  const std::size_t found = text_.find(mark, position_);
  if (found == std::string::npos) return false;
  position_ = found + mark.size();
  return true;
}

double FileCursor::real(const char* expected) {
  const std::string_view text = word(expected);
  double value = 0;
  if (!parse(text, value)) fail(printable(text), expected);
  return value;
}

std::int64_t FileCursor::integer(const char* expected) {
  const std::string_view text = word(expected);
  std::int64_t value = 0;
  if (!parse(text, value)) fail(printable(text), expected);
  return value;
}

std::size_t FileCursor::count(const char* expected) {
  const std::int64_t value = integer(expected);
  if (value < 0 || static_cast<std::size_t>(value) > remaining()) {
    fail(std::to_string(value) + " with " + std::to_string(remaining()) + " bytes left", expected);
  }
  return static_cast<std::size_t>(value);
}

void FileCursor::fail(std::string_view found, std::string_view expected) const {
  const auto line =
      1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(word_start_), '\n');
  throw InputError(name_ + ":" + std::to_string(line) + ": found " + std::string(found) + ", expected " +
                   std::string(expected));
}

}  // namespace omentum::geometry
