#include "organ/csv.h"

#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

namespace omentum::organ {

namespace {

// What spreadsheets put in front of UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

template <class T>
std::optional<T> parse_whole(const std::string& field) {
  // std::from_chars takes no plus sign
  const char* first = field.data() + (field.size() > 1 && field[0] == '+' ? 1 : 0);
  const char* const last = field.data() + field.size();
  T value{};
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last || first == last) return std::nullopt;
  return value;
}

// A name of a column, not a number gone wrong.
bool is_name(const std::string& field) {
  if (field.empty() || !std::isalpha(static_cast<unsigned char>(field[0]))) return false;
  return !parse_whole<double>(field);
}

}  // namespace

std::optional<double> parse_number(const std::string& field) {
  const auto value = parse_whole<double>(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int32_t> parse_integer(const std::string& field) {
  return parse_whole<std::int32_t>(field);
}

std::vector<std::string> split_fields(const std::string& line) {
  constexpr const char* kBlanks = " \t\r";
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    const std::string field = line.substr(begin, comma - begin);
    const std::size_t first = field.find_first_not_of(kBlanks);
    const std::size_t last = field.find_last_not_of(kBlanks);
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    begin = comma + 1;
  }
  return fields;
}

std::vector<CsvLine> read_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) {
    throw geometry::InputError(file.string() + ": cannot be read; expected a CSV file");
  }
  std::vector<CsvLine> lines;
  std::string text;
  bool first = true;
  for (int number = 1; std::getline(in, text); ++number) {
    if (number == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    std::vector<std::string> fields = split_fields(text);
    if (fields[0].empty() && fields.size() == 1) continue;
    if (fields[0].rfind('#', 0) == 0) continue;
    const bool header = first && std::ranges::all_of(fields, is_name);
    first = false;
    if (!header) lines.push_back({file.string() + ":" + std::to_string(number), std::move(fields)});
  }
  if (lines.empty()) throw geometry::InputError(file.string() + ": holds no numbers");
  return lines;
}

}  // namespace omentum::organ
